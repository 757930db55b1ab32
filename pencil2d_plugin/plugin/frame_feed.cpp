#include "plugin/frame_feed.h"

#include "plugin/layer_stack.h"

namespace lampblack
{

namespace
{
constexpr int MaxKiB = 256 * 1024;
}

FrameFeed::FrameFeed(Host& host, Worker& worker, SceneDocument& document, QObject* parent)
    : QObject(parent), mHost(host), mWorker(worker), mDocument(document), mApart(host), mExports(MaxKiB)
{
    connect(&host, &Host::frameChanged, this, &FrameFeed::requestCurrent);
    connect(&mApart, &LayersApart::exported, this, &FrameFeed::onFrameExported);
    connect(&mApart, &LayersApart::failed, this, &FrameFeed::frameFailed);
    connect(&host, &Host::drawingChanged, this,
            [this](int frame)
            {
                mApart.markChanged(frame, mHost.currentLayer());
                invalidate(frame);
                requestCurrent();
            });
    const auto startOver = [this]
    {
        invalidateAll();
        requestCurrent();
    };
    connect(&worker, &Worker::frameNeeded, this, [this](int frame) { mApart.request(frame, litLayers()); });
    connect(&host, &Host::layersChanged, this, startOver);
    connect(&host, &Host::projectOpened, this, startOver);
    connect(&document, &SceneDocument::layerRolesChanged, this, startOver);
}

void FrameFeed::setEnabled(bool enabled)
{
    mEnabled = enabled;
    if (enabled)
        requestCurrent();
    else
        cancelRequests();
}

FrameExport FrameFeed::lastExport(int frame) const
{
    const FrameExport* kept = mUpToDate.contains(frame) ? mExports.object(frame) : nullptr;
    return kept ? *kept : FrameExport{};
}

QStringList FrameFeed::litLayers() const
{
    const QVector<Layer> layers = mHost.layers();
    if (layers.isEmpty())
        return {};
    const QStringList lit = sortLayers(layers, mDocument.layerRoles()).lit;
    // An empty list would mean all layers; one empty name means none.
    return lit.isEmpty() ? QStringList(QString()) : lit;
}

void FrameFeed::requestAll(int first, int last)
{
    for (int frame = first; frame <= last; ++frame)
    {
        if (isUpToDate(frame))
            Q_EMIT frameSent(frame);
        else
            mApart.request(frame, litLayers());
    }
}

void FrameFeed::cancelAll()
{
    cancelRequests();
    requestCurrent();
}

void FrameFeed::cancelRequests()
{
    mHost.cancelRequests();
    mApart.cancel();
}

void FrameFeed::requestCurrent()
{
    if (!mEnabled)
        return;
    const int frame = mHost.currentFrame();
    if (isUpToDate(frame))
        Q_EMIT frameSent(frame);
    else
        mApart.request(frame, litLayers());
}

void FrameFeed::onFrameExported(const FrameExport& frame, const DrawnLayers& layers)
{
    if (frame.layers != litLayers())
        return;
    mWorker.putFrame(frame.frame, frame.image, frame.canvasToImage, layers);
    mUpToDate.insert(frame.frame);
    const int cost = int(frame.image.sizeInBytes() / 1024) + 1;
    mExports.insert(frame.frame, new FrameExport(frame), cost);
    Q_EMIT frameSent(frame.frame);
}

void FrameFeed::invalidate(int frame)
{
    mUpToDate.remove(frame);
    mExports.remove(frame);
    Q_EMIT frameOutdated(frame);
}

void FrameFeed::invalidateAll()
{
    QSet<int> outdated;
    mUpToDate.swap(outdated);
    outdated.insert(mHost.currentFrame());
    mExports.clear();
    cancelRequests();
    mApart.markAllChanged();
    mWorker.dropAllFrames();
    for (const int frame : qAsConst(outdated))
        Q_EMIT frameOutdated(frame);
}

} // namespace lampblack
