#include "stalls.h"

#include <QAbstractEventDispatcher>
#include <QJsonArray>
#include <QThread>

#include <algorithm>
#include <ctime>

namespace
{

qint64 threadCpuNs()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return qint64(now.tv_sec) * 1000000000 + now.tv_nsec;
}

QJsonObject histogram(QVector<double> milliseconds)
{
    std::sort(milliseconds.begin(), milliseconds.end());
    QJsonObject over;
    for (const int bound : {8, 16, 33, 50, 80, 160, 320})
    {
        const auto first = std::upper_bound(milliseconds.begin(), milliseconds.end(), double(bound));
        over.insert(QString::number(bound), int(milliseconds.end() - first));
    }
    return {{QStringLiteral("over"), over},
            {QStringLiteral("longest"), milliseconds.isEmpty() ? 0 : milliseconds.last()}};
}

} // namespace

Stalls::Stalls(QObject* parent) : QObject(parent)
{
    const auto* loop = QAbstractEventDispatcher::instance(thread());
    connect(loop, &QAbstractEventDispatcher::awake, this, &Stalls::wake);
    connect(loop, &QAbstractEventDispatcher::aboutToBlock, this, &Stalls::sleep);
}

void Stalls::reset()
{
    mWallMs.clear();
    mCpuMs.clear();
    mAwake = false;
}

QJsonObject Stalls::report() const
{
    return {{QStringLiteral("turns"), mWallMs.size()},
            {QStringLiteral("wall"), histogram(mWallMs)},
            {QStringLiteral("cpu"), histogram(mCpuMs)}};
}

void Stalls::wake()
{
    // It did not wait since the last call: the turn goes on.
    if (mAwake)
        return;
    mAwake = true;
    mWall.start();
    mCpuStart = threadCpuNs();
}

void Stalls::sleep()
{
    if (!mAwake)
        return;
    mAwake = false;
    mWallMs.append(double(mWall.nsecsElapsed()) / 1e6);
    mCpuMs.append(double(threadCpuNs() - mCpuStart) / 1e6);
}
