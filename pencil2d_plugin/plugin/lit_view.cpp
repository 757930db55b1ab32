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

QSize deviceSize(const QTransform& imageToWidget, const QWidget& widget, const QRectF& crop)
{
    const double zoom = std::sqrt(std::abs(imageToWidget.determinant())) * widget.devicePixelRatioF();
    const double scale = std::min({zoom, MaxSide / crop.width(), MaxSide / crop.height()});
    return {qBound(1, qCeil(crop.width() * scale), int(MaxSide)),
            qBound(1, qCeil(crop.height() * scale), int(MaxSide))};
}

} // namespace

LitView::LitView(Host& host, Worker& worker, FrameFeed& feed, UnlitLayers& unlit, LampTool& tool,
                 QObject* parent)
    : QObject(parent), mHost(host), mWorker(worker), mFeed(feed), mUnlit(unlit), mTool(tool),
      mPictures(MaxKiB)
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
    return mTool.isActive() && mTool.viewMode() && mHost.can(Host::Ability::View);
}

void LitView::forgetPictures()
{
    mPictures.clear();
    mTool.clearPicture();
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
        mTool.clearPicture();
        mTool.setLit(true); // it is what the artist wants to see
        return;
    }
    const PreviewImage* cached = mPictures.object(frame);
    const bool isKnown = mFeed.isUpToDate(frame);
    const auto fit = cached != nullptr ? mWorker.fit(*cached) : Worker::Fit::OldDrawing;
    const bool isLit = isKnown && fit == Worker::Fit::Current && mUnlit.isLoaded(frame);
    const bool isOld = cached == nullptr || (isKnown && fit == Worker::Fit::OldDrawing);
    if (isLit || (!isOld && frame != mShownFrame))
    {
        mTool.setUnlitLayers(mUnlit.below(frame), mUnlit.above(frame));
        mTool.setPicture(*cached);
    }
    else if (isOld)
    {
        mTool.clearPicture();
    }
    mShownFrame = frame;
    mTool.setLit(isLit);
    if (isLit)
        mPatience.stop();
    else if (!mPatience.isActive())
        mPatience.start();
}

void LitView::requestPicture()
{
    const int frame = mHost.currentFrame();
    const std::optional<QTransform> canvasToWidget = mHost.canvasToWidget();
    if (!isShowing() || !canvasToWidget)
    {
        mWorker.cancelPreview();
        return;
    }
    const FrameExport exported = mFeed.lastExport(frame);
    if (!mFeed.isUpToDate(frame))
        return;
    mTool.setFrame(exported);
    const QSize size = exported.image.isNull() ? mHost.canvasSize() : exported.image.size();
    const QTransform imageToWidget = exported.canvasToImage.inverted() * *canvasToWidget;
    const QRectF crop = visibleCrop(imageToWidget, *mHost.canvas(), size);
    if (crop.isEmpty())
        mWorker.cancelPreview();
    else
        mWorker.requestPreview(frame, *mTool.viewMode(), crop,
                               deviceSize(imageToWidget, *mHost.canvas(), crop));
}

void LitView::askAgain()
{
    // An answer may have been lost on its way. A busy worker has not forgotten.
    if (mWorker.state() == Worker::State::Ready)
        mWorker.cancelPreview();
    if (!mFeed.isUpToDate(mHost.currentFrame()))
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
    mTool.setUnlitLayers(mUnlit.below(image.frame), mUnlit.above(image.frame));
    mTool.setPicture(image);
    show();
}

} // namespace lampblack
