#include "plugin/lit_view.h"

#include <QEvent>
#include <QtMath>

#include <cmath>

namespace lampblack
{

namespace
{

constexpr int MaxKiB = 256 * 1024;
constexpr double MaxSide = 4096; // pixels

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
    connect(&mRequestTimer, &QTimer::timeout, this, &LitView::requestPicture);
    connect(&host, &Host::viewChanged, this, &LitView::onViewChanged);
    connect(&host, &Host::frameChanged, this, &LitView::onViewChanged);
    connect(&host, &Host::toolActivated, this, &LitView::onViewChanged);
    connect(&feed, &FrameFeed::frameSent, this,
            [this](int frame)
            {
                if (frame == mHost.currentFrame())
                    onViewChanged();
            });
    connect(&feed, &FrameFeed::frameOutdated, this,
            [this](int frame)
            {
                mPictures.remove(frame);
                if (frame == mHost.currentFrame())
                    mTool.clearPicture();
            });
    connect(&unlit, &UnlitLayers::loaded, this,
            [this](int frame)
            {
                if (frame == mHost.currentFrame())
                    showCached(frame);
            });
    connect(&tool, &LampTool::viewModeChanged, this,
            [this]
            {
                mPictures.clear();
                mTool.clearPicture();
                onViewChanged();
            });
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

void LitView::onViewChanged()
{
    const int frame = mHost.currentFrame();
    if (frame != mShownFrame)
    {
        mShownFrame = frame;
        showCached(frame);
    }
    mRequestTimer.start();
}

void LitView::showCached(int frame)
{
    const PreviewImage* cached = mPictures.object(frame);
    if (!isShowing() || !cached || !mWorker.isCurrent(*cached) || !mUnlit.isLoaded(frame))
    {
        mTool.clearPicture();
        return;
    }
    mTool.setUnlitLayers(mUnlit.below(frame), mUnlit.above(frame));
    mTool.setPicture(*cached);
}

void LitView::requestPicture()
{
    const int frame = mHost.currentFrame();
    const std::optional<QTransform> canvasToWidget = mHost.canvasToWidget();
    if (!isShowing() || !canvasToWidget)
    {
        mWorker.cancelPreview();
        mTool.clearPicture();
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

void LitView::onImageArrived(const PreviewImage& image)
{
    if (!isShowing() || image.show != mTool.viewMode())
        return;
    if (image.frame == mHost.currentFrame() && mUnlit.isLoaded(image.frame))
    {
        mTool.setUnlitLayers(mUnlit.below(image.frame), mUnlit.above(image.frame));
        mTool.setPicture(image);
    }
    mPictures.insert(image.frame, new PreviewImage(image), int(image.picture.sizeInBytes() / 1024) + 1);
}

} // namespace lampblack
