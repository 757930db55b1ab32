// Measures how long Qt's main thread does not return to its event loop.
#pragma once

#include <QElapsedTimer>
#include <QJsonObject>
#include <QObject>
#include <QVector>

/// Measures every turn of the event loop: from waking up to waiting again.
class Stalls : public QObject
{
public:
    explicit Stalls(QObject* parent = nullptr);

    void reset();

    /// The number of "turns". How many were longer than each bound in ms, and the longest: by the clock
    /// ("wall") and by processor time of the thread ("cpu").
    QJsonObject report() const;

private:
    void wake();
    void sleep();

    bool mAwake = false;
    QElapsedTimer mWall;
    qint64 mCpuStart = 0;
    QVector<double> mWallMs;
    QVector<double> mCpuMs;
};
