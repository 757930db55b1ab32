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
                redraw(framesLike(frame));
                if (mRest.interval() > 0)
                    mRest.start();
                else
                    requestCurrent();
            });
    connect(&host, &Host::drawingsChanged, this,
            [this]
            {
                redraw(mUpToDate.values().toVector());
                requestCurrent();
            });
    mRest.setSingleShot(true);
    mRest.setInterval(0);
    connect(&mRest, &QTimer::timeout, this, &FrameFeed::requestCurrent);
    const auto startOver = [this]
    {
        invalidateAll();
        requestCurrent();
    };
    connect(&worker, &Worker::frameNeeded, this, [this](int frame) { request(frame); });
    connect(&host, &Host::layersChanged, this, startOver);
    connect(&host, &Host::projectOpened, this, startOver);
    connect(&document, &SceneDocument::layerRolesChanged, this, startOver);
}

void FrameFeed::setEnabled(bool enabled)
{
    if (!enabled && !mEnabled)
        return;
    mEnabled = enabled;
    if (enabled)
        requestCurrent();
    else
        cancelRequests();
}

FrameExport FrameFeed::lastExport(int frame) const
{
    const Sent* kept = mUpToDate.contains(frame) ? mExports.object(frame) : nullptr;
    return kept ? kept->frame : FrameExport{};
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
            request(frame);
    }
}

void FrameFeed::cancelAll()
{
    cancelRequests();
    requestCurrent();
}

void FrameFeed::request(int frame)
{
    mApart.request(frame, {litLayers(), sortLayers(mHost.layers(), mDocument.layerRoles()).light});
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
        request(frame);
}

void FrameFeed::onFrameExported(const FrameExport& frame, const DrawnLayers& layers)
{
    if (frame.layers != litLayers())
        return;
    mWorker.putFrame(frame.frame, frame.image, frame.canvasToImage, layers);
    mUpToDate.insert(frame.frame);
    const bool isLit = !layers.isEmpty() && layers.last().name == lightLayer();
    const Sent sent{frame, isLit ? layers.last().pixels : QImage()};
    const Sent before = mBefore.take(frame.frame);
    if (!before.frame.image.isNull() && before.frame.image == frame.image && before.light == sent.light)
        Q_EMIT frameSame(frame.frame);
    const int cost = int((frame.image.sizeInBytes() + sent.light.sizeInBytes()) / 1024) + 1;
    mExports.insert(frame.frame, new Sent(sent), cost);
    Q_EMIT frameSent(frame.frame);
}

void FrameFeed::redraw(const QVector<int>& frames)
{
    for (const int frame : frames)
    {
        mApart.markChanged(frame, mHost.currentLayer());
        invalidate(frame);
        Q_EMIT frameRedrawn(frame);
    }
}

/// The frame and those that show the same drawing, or may do so: a drawing is held over several frames, and
/// painted light over several drawings.
QVector<int> FrameFeed::framesLike(int frame) const
{
    QVector<int> frames{frame};
    const bool isLight = lampblack::isLight(mHost.currentLayer(), mDocument.layerRoles());
    const Sent* changed = isLight ? nullptr : mExports.object(frame);
    for (const int other : mUpToDate)
    {
        const Sent* shown = mExports.object(other);
        if (other != frame &&
            (changed == nullptr || shown == nullptr || shown->frame.image == changed->frame.image))
            frames.append(other);
    }
    return frames;
}

void FrameFeed::invalidate(int frame)
{
    const Sent* last = mUpToDate.contains(frame) ? mExports.object(frame) : nullptr;
    if (last != nullptr && !mBefore.contains(frame))
        mBefore.insert(frame, *last);
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
    mBefore.clear();
    cancelRequests();
    mApart.markAllChanged();
    mWorker.dropAllFrames();
    for (const int frame : qAsConst(outdated))
        Q_EMIT frameOutdated(frame);
}

} // namespace lampblack
