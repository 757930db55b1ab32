#include "plugin/frame_feed.h"

#include "plugin/layer_stack.h"

namespace lampblack
{

namespace
{
constexpr int MostKept = 256 * 1024; // KiB
}

FrameFeed::FrameFeed(Host& host, Worker& worker, SceneDocument& document, QObject* parent)
    : QObject(parent), mHost(host), mWorker(worker), mDocument(document), mExports(MostKept)
{
    connect(&host, &Host::frameChanged, this, &FrameFeed::wantCurrent);
    connect(&host, &Host::frameExported, this, &FrameFeed::take);
    connect(&host, &Host::exportFailed, this, &FrameFeed::failed);
    connect(&host, &Host::drawingChanged, this,
            [this](int frame)
            {
                forget(frame);
                wantCurrent();
            });
    const auto startOver = [this]
    {
        forgetAll();
        wantCurrent();
    };
    connect(&worker, &Worker::frameWanted, this,
            [this](int frame) { mHost.requestFrames(frame, frame, litLayers()); });
    connect(&host, &Host::layersChanged, this, startOver);
    connect(&host, &Host::projectOpened, this, startOver);
    connect(&document, &SceneDocument::layerRolesChanged, this, startOver);
}

void FrameFeed::setOn(bool on)
{
    mOn = on;
    if (on)
        wantCurrent();
    else
        mHost.cancelRequests();
}

FrameExport FrameFeed::lastExport(int frame) const
{
    const FrameExport* kept = mFresh.contains(frame) ? mExports.object(frame) : nullptr;
    return kept ? *kept : FrameExport{};
}

QStringList FrameFeed::litLayers() const
{
    const QVector<Layer> layers = mHost.layers();
    if (layers.isEmpty()) // they cannot be named
        return {};
    const QStringList lit = stackLayers(layers, mDocument.layerRoles()).lit;
    // Nothing to light is no layer at all, not every one.
    return lit.isEmpty() ? QStringList(QString()) : lit;
}

void FrameFeed::wantAll(int first, int last)
{
    for (int frame = first; frame <= last; ++frame)
    {
        if (isFresh(frame))
            Q_EMIT freshened(frame);
        else
            mHost.requestFrames(frame, frame, litLayers());
    }
}

void FrameFeed::stopWanting()
{
    mHost.cancelRequests();
    wantCurrent();
}

void FrameFeed::wantCurrent()
{
    if (!mOn)
        return;
    const int frame = mHost.currentFrame();
    if (isFresh(frame))
        Q_EMIT freshened(frame);
    else
        mHost.requestFrames(frame, frame, litLayers());
}

void FrameFeed::take(const FrameExport& frame)
{
    if (frame.layers != litLayers())
        return;
    mWorker.putFrame(frame.frame, frame.image, frame.canvasToImage);
    mFresh.insert(frame.frame);
    const int cost = int(frame.image.sizeInBytes() / 1024) + 1;
    mExports.insert(frame.frame, new FrameExport(frame), cost);
    Q_EMIT freshened(frame.frame);
}

void FrameFeed::forget(int frame)
{
    mFresh.remove(frame);
    mExports.remove(frame);
    Q_EMIT staled(frame);
}

void FrameFeed::forgetAll()
{
    QSet<int> stale;
    mFresh.swap(stale);
    stale.insert(mHost.currentFrame());
    mExports.clear();
    mHost.cancelRequests();
    mWorker.dropAllFrames();
    for (const int frame : qAsConst(stale))
        Q_EMIT staled(frame);
}

} // namespace lampblack
