#include "plugin/surroundings.h"

namespace lampblack
{

namespace
{
constexpr int MostKept = 256 * 1024; // KiB
}

Surroundings::Surroundings(Host& host, FrameFeed& feed, SceneDocument& document, QObject* parent)
    : QObject(parent), mHost(host), mFeed(feed), mDocument(document), mKept(MostKept)
{
    connect(&feed, &FrameFeed::freshened, this, &Surroundings::want);
    connect(&feed, &FrameFeed::staled, this, &Surroundings::forget);
    connect(&host, &Host::frameExported, this, &Surroundings::take);
    connect(&host, &Host::exportFailed, this, &Surroundings::giveUp);
}

bool Surroundings::isKnown(int frame) const
{
    const LayerStack layers = stack();
    return (layers.below.isEmpty() || mKept.contains({frame, layers.below})) &&
           (layers.above.isEmpty() || mKept.contains({frame, layers.above}));
}

LayerStack Surroundings::stack() const
{
    return stackLayers(mHost.layers(), mDocument.layerRoles());
}

FrameExport Surroundings::kept(int frame, const QStringList& layers) const
{
    const FrameExport* kept = mKept.object({frame, layers});
    return kept ? *kept : FrameExport();
}

void Surroundings::want(int frame)
{
    const LayerStack layers = stack();
    for (const QStringList& names : {layers.below, layers.above})
    {
        if (!names.isEmpty() && !mKept.contains({frame, names}))
            mHost.requestFrames(frame, frame, names);
    }
}

void Surroundings::take(FrameExport frame)
{
    const LayerStack layers = stack();
    if (frame.layers.isEmpty() || (frame.layers != layers.below && frame.layers != layers.above))
        return;
    // A background is mostly the same in all frames: its pixels are kept once.
    QImage& last = mLast[frame.layers];
    const bool held = frame.image == last;
    if (held)
        frame.image = last;
    else
        last = frame.image;
    const int cost = held ? 1 : int(frame.image.sizeInBytes() / 1024) + 1;
    mKept.insert({frame.frame, frame.layers}, new FrameExport(frame), cost);
    Q_EMIT arrived(frame.frame);
}

void Surroundings::forget(int frame)
{
    const QList<Key> keys = mKept.keys();
    for (const Key& key : keys)
    {
        if (key.first == frame)
            mKept.remove(key);
    }
}

void Surroundings::giveUp(int frame)
{
    if (!mFeed.isFresh(frame) || isKnown(frame))
        return;
    // Better lit without a background than never.
    const LayerStack layers = stack();
    for (const QStringList& names : {layers.below, layers.above})
    {
        if (!mKept.contains({frame, names}))
            mKept.insert({frame, names}, new FrameExport());
    }
    Q_EMIT arrived(frame);
}

} // namespace lampblack
