// How long Qt's UI thread is away from its event loop.
#pragma once

#include <QElapsedTimer>
#include <QJsonObject>
#include <QObject>
#include <QVector>

/// Measures every turn of the event loop: from waking up to going back to sleep.
class Stalls : public QObject
{
public:
    explicit Stalls(QObject* parent = nullptr);

    void reset();

    /// "turns", and of the turns longer than each bound in ms: how many by the clock ("wall") and
    /// how many by the thread's own processor time ("cpu"), with the longest of each.
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
