#include "plugin/lit_view.h"

#include <QEvent>
#include <QtMath>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lampblack
{

namespace
{

constexpr int MaxKiB = 256 * 1024;
constexpr double MaxSide = 4096;     // pixels
constexpr int FirstPatienceMs = 700; ///< after which a picture is asked for again, twice as long each time
constexpr int LongestPatienceMs = 20000;

/// The part of an image of `size` that `widget` shows, grown to whole pixels.
QRectF visibleCrop(const QTransform& imageToWidget, const QWidget& widget, const QSize& size)
{
    bool invertible = false;
    const QTransform back = imageToWidget.inverted(&invertible);
    if (!invertible)
        return {};
    const QRectF seen = back.mapRect(QRectF(widget.rect())).intersected(QRectF(QPointF(), QSizeF(size)));
    return seen.isEmpty() ? QRectF() : QRectF(seen.toAlignedRect().intersected(QRect(QPoint(), size)));
}

/// But for rounding.
bool covers(const QRectF& crop, const QRectF& inSight)
{
    const QRectF needed = inSight.adjusted(1, 1, -1, -1);
    return needed.isEmpty() || crop.contains(needed);
}

QSize deviceSize(const QTransform& imageToWidget, const QWidget& widget, const QRectF& crop)
{
    const double zoom = std::sqrt(std::abs(imageToWidget.determinant())) * widget.devicePixelRatioF();
    const double scale = std::min({zoom, MaxSide / crop.width(), MaxSide / crop.height()});
    return {qBound(1, qCeil(crop.width() * scale), int(MaxSide)),
            qBound(1, qCeil(crop.height() * scale), int(MaxSide))};
}

} // namespace

LitView::LitView(Host& host, Worker& worker, FrameFeed& feed, UnlitLayers& unlit, SceneDocument& document,
                 LampTool& tool, QObject* parent)
    : QObject(parent), mHost(host), mWorker(worker), mFeed(feed), mUnlit(unlit), mTool(tool),
      mStandIns(host, worker, feed, unlit, document), mPictures(MaxKiB)
{
    mRequestTimer.setSingleShot(true);
    mRequestTimer.setInterval(0);
    mPatience.setSingleShot(true);
    mPatience.setInterval(FirstPatienceMs);
    connect(&mRequestTimer, &QTimer::timeout, this, &LitView::requestPicture);
    connect(&mPatience, &QTimer::timeout, this, &LitView::askAgain);
    connect(&host, &Host::viewChanged, this, &LitView::onViewChanged);
    connect(&host, &Host::frameChanged, this, &LitView::onViewChanged);
    connect(&host, &Host::toolActivated, this, &LitView::onViewChanged);
    connect(&tool, &LampTool::lightingChanged, this, &LitView::onViewChanged);
    connect(&host, &Host::projectOpened, this, &LitView::forgetPictures);
    connect(&feed, &FrameFeed::frameSent, this, &LitView::onFrameChanged);
    connect(&feed, &FrameFeed::frameOutdated, this, &LitView::onFrameChanged);
    connect(&unlit, &UnlitLayers::loaded, this, &LitView::onFrameChanged);
    connect(&worker, &Worker::drawingKnown, this, &LitView::onFrameChanged);
    connect(&tool, &LampTool::viewModeChanged, this, &LitView::forgetPictures);
    connect(&worker, &Worker::imageArrived, this, &LitView::onImageArrived);
    host.canvas()->installEventFilter(this);
}

bool LitView::eventFilter(QObject*, QEvent* event)
{
    if (event->type() == QEvent::Resize)
        onViewChanged();
    return false;
}

bool LitView::isShowing() const
{
    // On lit frames light would lie twice.
    return (mTool.isActive() || (mTool.isDrawing() && !mStandIns.showsResult())) && mTool.viewMode() &&
           mHost.can(Host::Ability::View);
}

void LitView::forgetPictures()
{
    mPictures.clear();
    showNothing();
    onViewChanged();
}

void LitView::onViewChanged()
{
    mPatience.setInterval(FirstPatienceMs);
    onFrameChanged(mHost.currentFrame());
}

void LitView::onFrameChanged(int frame)
{
    if (frame != mHost.currentFrame())
        return;
    show();
    mRequestTimer.start();
}

void LitView::onSceneSent()
{
    mPatience.setInterval(FirstPatienceMs);
    show();
}

void LitView::show()
{
    const int frame = mHost.currentFrame();
    if (!isShowing())
    {
        mPatience.stop();
        showNothing();
        setLit(true); // it is what the artist wants to see
        return;
    }
    const PreviewImage* cached = mPictures.object(frame);
    const bool isKnown = mFeed.isUpToDate(frame);
    const auto fit = cached != nullptr ? mWorker.fit(*cached) : Worker::Fit::OldDrawing;
    const bool isLit = isKnown && fit == Worker::Fit::Current && mUnlit.isLoaded(frame) &&
                       covers(cached->crop, cropInSight());
    const bool isOld = cached == nullptr || (isKnown && fit == Worker::Fit::OldDrawing);
    const bool isOtherFrame = std::exchange(mShownFrame, frame) != frame;
    // The light of the last drawing is good for the next stroke.
    const bool lasts = mTool.isDrawing() && mShown != Shown::Nothing;
    const bool stays = !isOtherFrame && (lasts || (!isOld && mShown == Shown::Lit));
    const bool returns = !isOld && fit != Worker::Fit::OldScene;
    bool isEmpty = false;
    if (isLit || (!lasts && (stays || returns) && mUnlit.isLoaded(frame)))
        showPicture(*cached);
    else if (!stays)
        isEmpty = !showStandIn();
    setLit(isLit || isEmpty);
    if (isLit || isEmpty)
        mPatience.stop();
    else if (!mPatience.isActive())
        mPatience.start();
}

void LitView::showPicture(const PreviewImage& picture)
{
    mTool.setUnlitLayers(mUnlit.below(picture.frame), mUnlit.above(picture.frame));
    mTool.setPicture(picture);
    const FrameExport drawn = mFeed.lastExport(picture.frame);
    std::optional<StandIn> rest;
    if (picture.show == Show::Lit && !covers(picture.crop, cropInSight()))
        rest = mStandIns.current();
    mTool.setStandIn(rest ? rest->picture : PreviewImage(), rest ? rest->canvasToImage : QTransform());
    mTool.setDrawn(mWorker.fit(picture) == Worker::Fit::OldDrawing ? FrameExport() : drawn);
    mShown = Shown::Lit;
}

/// False if the frame is known to have nothing to light.
bool LitView::showStandIn()
{
    const std::optional<StandIn> found = mTool.viewMode() == Show::Lit ? mStandIns.current() : std::nullopt;
    if (!found || found->picture.picture.isNull())
    {
        showNothing();
        return !found || found->isWhole;
    }
    const int frame = mHost.currentFrame();
    mTool.setUnlitLayers(found->isWhole ? FrameExport() : mUnlit.below(frame),
                         found->isWhole ? FrameExport() : mUnlit.above(frame));
    mTool.setPicture(PreviewImage());
    mTool.setStandIn(found->picture, found->canvasToImage);
    mTool.setDrawn(found->drawn);
    mShown = Shown::StandIn;
    return true;
}

void LitView::showNothing()
{
    mTool.clearPicture();
    mShown = Shown::Nothing;
}

QRectF LitView::cropInSight() const
{
    const FrameExport exported = mFeed.lastExport(mHost.currentFrame());
    const std::optional<QTransform> canvasToWidget = mHost.canvasToWidget();
    if (!canvasToWidget)
        return {};
    const QSize size = exported.image.isNull() ? mHost.canvasSize() : exported.image.size();
    return visibleCrop(exported.canvasToImage.inverted() * *canvasToWidget, *mHost.canvas(), size);
}

void LitView::requestPicture()
{
    const int frame = mHost.currentFrame();
    if (!isShowing() || !mHost.canvasToWidget())
    {
        mWorker.cancelPreview();
        return;
    }
    if (!mFeed.isUpToDate(frame))
        return;
    const FrameExport exported = mFeed.lastExport(frame);
    mTool.setFrame(exported);
    const QTransform imageToWidget = exported.canvasToImage.inverted() * *mHost.canvasToWidget();
    const QRectF crop = cropInSight();
    if (crop.isEmpty())
        mWorker.cancelPreview();
    else
        mWorker.requestPreview(frame, *mTool.viewMode(), crop,
                               deviceSize(imageToWidget, *mHost.canvas(), crop));
}

void LitView::setLit(bool lit)
{
    mIsLit = lit;
    mTool.setLit(lit);
}

void LitView::askAgain()
{
    // An answer may have been lost on its way. A busy worker has not forgotten.
    if (mWorker.state() == Worker::State::Ready)
        mWorker.cancelPreview();
    if (!mFeed.isUpToDate(mHost.currentFrame()) && !mFeed.isResting())
        mFeed.requestCurrent();
    requestPicture();
    mPatience.start(std::min(2 * mPatience.interval(), LongestPatienceMs));
}

void LitView::onImageArrived(const PreviewImage& image)
{
    if (!isShowing() || image.show != mTool.viewMode())
        return;
    mPictures.insert(image.frame, new PreviewImage(image), int(image.picture.sizeInBytes() / 1024) + 1);
    if (image.frame != mHost.currentFrame() || !mUnlit.isLoaded(image.frame))
        return;
    // Compared with a drawing that has a new stroke, the picture of the drawing before would take it away.
    const Worker::Fit fit = mWorker.fit(image);
    const bool isLate = fit == Worker::Fit::Unknown || fit == Worker::Fit::OldDrawing;
    if (!isLate || !mTool.isDrawing())
        showPicture(image);
    show();
}

} // namespace lampblack
