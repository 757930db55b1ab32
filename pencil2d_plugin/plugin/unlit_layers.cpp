#include "plugin/unlit_layers.h"

namespace lampblack
{

namespace
{
constexpr int MaxKiB = 256 * 1024;
}

UnlitLayers::UnlitLayers(Host& host, FrameFeed& feed, SceneDocument& document, QObject* parent)
    : QObject(parent), mHost(host), mFeed(feed), mDocument(document), mCache(MaxKiB)
{
    connect(&feed, &FrameFeed::frameSent, this, &UnlitLayers::requestFrame);
    connect(&feed, &FrameFeed::frameOutdated, this, &UnlitLayers::invalidate);
    connect(&host, &Host::frameExported, this, &UnlitLayers::onFrameExported);
    connect(&host, &Host::exportFailed, this, &UnlitLayers::onExportFailed);
}

bool UnlitLayers::isLoaded(int frame) const
{
    const LayerStack layers = stack();
    return (layers.below.isEmpty() || mCache.contains({frame, layers.below})) &&
           (layers.above.isEmpty() || mCache.contains({frame, layers.above}));
}

LayerStack UnlitLayers::stack() const
{
    return sortLayers(mHost.layers(), mDocument.layerRoles());
}

FrameExport UnlitLayers::cached(int frame, const QStringList& layers) const
{
    const FrameExport* cached = mCache.object({frame, layers});
    return cached ? *cached : FrameExport();
}

void UnlitLayers::requestFrame(int frame)
{
    const LayerStack layers = stack();
    for (const QStringList& names : {layers.below, layers.above})
    {
        if (!names.isEmpty() && !mCache.contains({frame, names}))
            mHost.requestFrames(frame, frame, names);
    }
}

void UnlitLayers::onFrameExported(FrameExport frame)
{
    const LayerStack layers = stack();
    if (frame.layers.isEmpty() || (frame.layers != layers.below && frame.layers != layers.above))
        return;
    // A background is often the same in all frames. Its pixels are kept once.
    QImage& last = mLastImages[frame.layers];
    const bool unchanged = frame.image == last;
    if (unchanged)
        frame.image = last;
    else
        last = frame.image;
    const int cost = unchanged ? 1 : int(frame.image.sizeInBytes() / 1024) + 1;
    mCache.insert({frame.frame, frame.layers}, new FrameExport(frame), cost);
    Q_EMIT loaded(frame.frame);
}

void UnlitLayers::invalidate(int frame)
{
    const QList<Key> keys = mCache.keys();
    for (const Key& key : keys)
    {
        if (key.first == frame)
            mCache.remove(key);
    }
}

void UnlitLayers::onExportFailed(int frame)
{
    if (!mFeed.isUpToDate(frame) || isLoaded(frame))
        return;
    // A lit picture without its background is better than none.
    const LayerStack layers = stack();
    for (const QStringList& names : {layers.below, layers.above})
    {
        if (!mCache.contains({frame, names}))
            mCache.insert({frame, names}, new FrameExport());
    }
    Q_EMIT loaded(frame);
}

} // namespace lampblack
