#include "host/frame_queue.h"

#include <QDir>
#include <QElapsedTimer>
#include <QImageReader>

namespace lampblack
{

namespace
{

constexpr int BreathMs = 10;   ///< between chunks, for the artist's events
constexpr int RetryMs = 60;    ///< while the artist is busy
constexpr double ChunkMs = 40; ///< what a chunk may hold the main thread; one frame may take longer
constexpr int MaxChunk = 8;
constexpr int MaxFrame = 9999;
constexpr int MaxSide = 4096; ///< the dialog's own limit

QImage readPng(const QString& path)
{
    QImageReader reader(path, "png");
    const QSize size = reader.size();
    if (!size.isValid() || size.width() > MaxSide || size.height() > MaxSide)
        return {};
    return reader.read().convertToFormat(QImage::Format_RGBA8888);
}

} // namespace

FrameQueue::FrameQueue(const Parts& parts, Idleness* idleness, QObject* parent)
    : QObject(parent), mParts(parts), mIdleness(idleness), mRows(parts), mDialog(parts),
      mFolder(QDir::temp().filePath(QStringLiteral("lampblack-XXXXXX")))
{
    mReaders.setMaxThreadCount(1);
    mTimer.setSingleShot(true);
    connect(&mTimer, &QTimer::timeout, this, &FrameQueue::work);
}

FrameQueue::~FrameQueue()
{
    mReaders.clear();
    mReaders.waitForDone();
}

void FrameQueue::request(int first, int last, const QStringList& layers)
{
    for (int frame = qMax(1, first); frame <= qMin(last, MaxFrame); ++frame)
        mWanted.insert({frame, layers}, 0);
    if (!mWanted.isEmpty() && !mTimer.isActive())
        mTimer.start(0);
}

void FrameQueue::cancel()
{
    mWanted.clear();
    mNewest.clear();
    mTimer.stop();
}

void FrameQueue::work()
{
    if (mWanted.isEmpty())
        return;
    if (mPlaying || !mIdleness->isIdle())
    {
        mTimer.start(RetryMs);
        return;
    }
    const auto current = mWanted.lowerBound({mCurrentFrame, {}});
    const bool isCurrent = current != mWanted.end() && current.key().first == mCurrentFrame;
    const auto [first, layers] = isCurrent ? current.key() : mWanted.firstKey();
    const int most = qBound(1, int(ChunkMs / mFrameMs), MaxChunk);
    int last = first;
    while (last - first + 1 < most && mWanted.contains({last + 1, layers}))
        ++last;
    exportChunk(first, last, layers);
    if (!mWanted.isEmpty())
        mTimer.start(BreathMs);
}

void FrameQueue::exportChunk(int first, int last, const QStringList& layers)
{
    const Idleness::Work work(mIdleness);
    QElapsedTimer clock;
    clock.start();

    const QString folder = mFolder.filePath(QString::number(++mExports));
    if (!mFolder.isValid() || !QDir().mkpath(folder))
    {
        for (int frame = first; frame <= last; ++frame)
            fail({frame, layers}, mWanted.take({frame, layers}),
                 QStringLiteral("No temporary folder: %1").arg(mFolder.errorString()));
        return;
    }

    Exported exported;
    {
        QVector<int> turned;
        const UpdatesOff unseen(layers.isEmpty()
                                    ? QVector<QWidget*>()
                                    : QVector<QWidget*>{mParts.canvas, mParts.layerCells, mParts.trackCells});
        if (!layers.isEmpty())
        {
            const QVector<bool> eyes = mRows.eyes(mLayers.size());
            for (int row = 0; row < mLayers.size(); ++row)
            {
                const bool drawn =
                    mLayers[row].kind != Layer::Kind::Camera && mLayers[row].kind != Layer::Kind::Sound;
                if (drawn && eyes[row] != layers.contains(mLayers[row].name))
                    turned.append(row);
            }
        }
        for (const int row : qAsConst(turned))
            mRows.clickEye(row);
        exported = mDialog.run(first, last, mCamera, folder);
        for (const int row : qAsConst(turned))
            mRows.clickEye(row);
    }
    mFrameMs = double(clock.elapsed()) / (last - first + 1);

    for (int frame = first; frame <= last; ++frame)
    {
        const int failures = mWanted.take({frame, layers});
        if (exported.files.contains(frame))
            readLater({frame, layers}, failures, exported.files.value(frame), mExports);
        else
            fail({frame, layers}, failures, exported.fault);
    }
    Q_EMIT looked(exported);
}

void FrameQueue::fail(const Wanted& wanted, int failures, const QString& details)
{
    constexpr int MaxAttempts = 3;
    if (failures + 1 < MaxAttempts)
    {
        mWanted.insert(wanted, failures + 1);
        if (!mTimer.isActive())
            mTimer.start(RetryMs);
        return;
    }
    Q_EMIT failed(wanted.first,
                  {QStringLiteral("Frame %1 could not be read from Pencil2D.").arg(wanted.first),
                   QStringLiteral("Save the project, then try again."), details});
}

void FrameQueue::readLater(const Wanted& wanted, int failures, const QString& path, quint64 number)
{
    ++mReading;
    mNewest.insert(wanted, number);
    mReaders.start(
        [this, wanted, failures, path, number]
        {
            const QImage image = readPng(path);
            QFile::remove(path);
            QDir().rmdir(QFileInfo(path).path());
            QMetaObject::invokeMethod(
                this,
                [this, wanted, failures, image, number]
                {
                    --mReading;
                    if (mNewest.value(wanted) != number)
                        return;
                    mNewest.remove(wanted);
                    const auto [frame, layers] = wanted;
                    if (image.isNull())
                        fail(wanted, failures, QStringLiteral("The exported PNG could not be read."));
                    else
                        Q_EMIT exported(frame, layers, image);
                },
                Qt::QueuedConnection);
        });
}

} // namespace lampblack
