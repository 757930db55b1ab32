#include "host/frame_queue.h"

#include "own_folder.h"

#include <QDir>
#include <QElapsedTimer>
#include <QImageReader>

namespace lampblack
{

namespace
{

constexpr int PauseMs = 10;    ///< between chunks, so that the artist's events are handled
constexpr int RetryMs = 60;    ///< while the artist is busy
constexpr double ChunkMs = 40; ///< how long a chunk may block the main thread, but it has at least one frame
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
      mFolder(ownFolderTemplate())
{
    mReaders.setMaxThreadCount(1);
    mTimer.setSingleShot(true);
    connect(&mTimer, &QTimer::timeout, this, &FrameQueue::exportNext);
}

FrameQueue::~FrameQueue()
{
    mReaders.clear();
    mReaders.waitForDone();
}

void FrameQueue::request(int first, int last, const QStringList& layers)
{
    for (int frame = qMax(1, first); frame <= qMin(last, MaxFrame); ++frame)
    {
        mRequests.insert({frame, layers}, 0);
        mNewest.remove({frame, layers}); // what is being read shows the frame as it was
    }
    if (!mRequests.isEmpty() && !mTimer.isActive())
        mTimer.start(0);
}

void FrameQueue::cancel()
{
    mRequests.clear();
    mNewest.clear();
    mTimer.stop();
}

void FrameQueue::exportNext()
{
    if (mRequests.isEmpty())
        return;
    if (mPlaying || mWaiting || !mIdleness->isIdle())
    {
        mTimer.start(RetryMs);
        return;
    }
    const auto current = mRequests.lowerBound({mCurrentFrame, {}});
    const bool isCurrent = current != mRequests.end() && current.key().first == mCurrentFrame;
    const auto [first, layers] = isCurrent ? current.key() : mRequests.firstKey();
    const int maxFrames = qBound(1, int(ChunkMs / mFrameMs), MaxChunk);
    int last = first;
    while (last - first + 1 < maxFrames && mRequests.contains({last + 1, layers}))
        ++last;
    exportChunk(first, last, layers);
    if (!mRequests.isEmpty())
        mTimer.start(PauseMs);
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
            retryOrFail({frame, layers}, mRequests.take({frame, layers}),
                        QStringLiteral("No temporary folder: %1").arg(mFolder.errorString()));
        return;
    }

    ExportResult exported;
    {
        QVector<int> clicked;
        const UpdatesOff updatesOff(layers.isEmpty() ? nullptr : mParts.window);
        if (!layers.isEmpty())
        {
            const QVector<bool> eyes = mRows.eyes(mLayers.size());
            for (int row = 0; row < mLayers.size(); ++row)
            {
                const bool isDrawing =
                    mLayers[row].kind != Layer::Kind::Camera && mLayers[row].kind != Layer::Kind::Sound;
                if (isDrawing && eyes[row] != layers.contains(mLayers[row].name))
                    clicked.append(row);
            }
        }
        for (const int row : qAsConst(clicked))
            mRows.clickEye(row);
        exported = mDialog.exportFrames(first, last, mCamera, folder);
        for (const int row : qAsConst(clicked))
            mRows.clickEye(row);
    }
    mFrameMs = double(clock.elapsed()) / (last - first + 1);

    for (int frame = first; frame <= last; ++frame)
    {
        const int failures = mRequests.take({frame, layers});
        if (exported.files.contains(frame))
            readLater({frame, layers}, failures, exported.files.value(frame), mExports);
        else
            retryOrFail({frame, layers}, failures, exported.error);
    }
    Q_EMIT dialogRead(exported);
}

void FrameQueue::retryOrFail(const Request& request, int failures, const QString& details)
{
    constexpr int MaxAttempts = 3;
    if (failures + 1 < MaxAttempts)
    {
        mRequests.insert(request, failures + 1);
        if (!mTimer.isActive())
            mTimer.start(RetryMs);
        return;
    }
    Q_EMIT failed(request.first,
                  {QStringLiteral("Frame %1 could not be read from Pencil2D.").arg(request.first),
                   QStringLiteral("Save the project, then try again."), details});
}

void FrameQueue::readLater(const Request& request, int failures, const QString& path, quint64 number)
{
    ++mReading;
    mNewest.insert(request, number);
    mReaders.start(
        [this, request, failures, path, number]
        {
            const QImage image = readPng(path);
            QFile::remove(path);
            QDir().rmdir(QFileInfo(path).path());
            QMetaObject::invokeMethod(
                this,
                [this, request, failures, image, number]
                {
                    --mReading;
                    if (mNewest.value(request) != number)
                        return;
                    mNewest.remove(request);
                    const auto [frame, layers] = request;
                    if (image.isNull())
                        retryOrFail(request, failures, QStringLiteral("The exported PNG could not be read."));
                    else
                        Q_EMIT exported(frame, layers, image);
                },
                Qt::QueuedConnection);
        });
}

} // namespace lampblack
