// What a widget has shown on the screen, over a time.
#pragma once

#include <QColor>
#include <QElapsedTimer>
#include <QJsonArray>
#include <QObject>
#include <QPointer>
#include <QTimer>
#include <QVector>
#include <QWidget>

/// Looks at the window's own pixels, those that are on the screen, many times a second and after each paint:
/// how many of a widget's pixels have exactly one of some colours.
class Sightings : public QObject
{
public:
    explicit Sightings(QObject* parent);

    /// Begin afresh. Without a widget nothing is looked at.
    void watch(QWidget* widget, const QVector<QColor>& colours);
    /// [milliseconds, share] of each look, where it differs from the one before.
    QJsonArray taken() const { return mTaken; }

    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void look();

    QPointer<QWidget> mWidget;
    QVector<QRgb> mColours;
    QTimer mTimer;
    QElapsedTimer mClock;
    QJsonArray mTaken;
    double mLast = -1;
    bool mPainted = false;
};
