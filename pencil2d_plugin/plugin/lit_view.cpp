#include "plugin/lit_view.h"

#include <QEvent>
#include <QtMath>

#include <cmath>

namespace lampblack
{

namespace
{

constexpr int MostKept = 256 * 1024; // KiB
constexpr double LongestSide = 4096;

/// The part of an image of `size` that is in sight of `widget`, grown to whole pixels.
QRectF cropInSight(const QTransform& imageToWidget, const QWidget& widget, const QSize& size)
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
    const double scale = std::min({zoom, LongestSide / crop.width(), LongestSide / crop.height()});
    return {qBound(1, qCeil(crop.width() * scale), int(LongestSide)),
            qBound(1, qCeil(crop.height() * scale), int(LongestSide))};
}

} // namespace

LitView::LitView(Host& host, Worker& worker, FrameFeed& feed, Surroundings& around, LampTool& tool,
                 QObject* parent)
    : QObject(parent), mHost(host), mWorker(worker), mFeed(feed), mAround(around), mTool(tool),
      mKept(MostKept)
{
    mSoon.setSingleShot(true);
    mSoon.setInterval(0);
    connect(&mSoon, &QTimer::timeout, this, &LitView::ask);
    connect(&host, &Host::viewChanged, this, &LitView::update);
    connect(&host, &Host::frameChanged, this, &LitView::update);
    connect(&host, &Host::toolActivated, this, &LitView::update);
    connect(&feed, &FrameFeed::freshened, this,
            [this](int frame)
            {
                if (frame == mHost.currentFrame())
                    update();
            });
    connect(&feed, &FrameFeed::staled, this,
            [this](int frame)
            {
                mKept.remove(frame);
                if (frame == mHost.currentFrame())
                    mTool.clearPicture();
            });
    connect(&around, &Surroundings::arrived, this,
            [this](int frame)
            {
                if (frame == mHost.currentFrame())
                    show(frame);
            });
    connect(&tool, &LampTool::viewModeChanged, this,
            [this]
            {
                mKept.clear();
                mTool.clearPicture();
                update();
            });
    connect(&worker, &Worker::imageArrived, this, &LitView::take);
    host.canvas()->installEventFilter(this);
}

bool LitView::eventFilter(QObject*, QEvent* event)
{
    if (event->type() == QEvent::Resize)
        update();
    return false;
}

bool LitView::isLooking() const
{
    return mTool.isActive() && mTool.viewMode() != ViewMode::Flat && mHost.can(Host::Ability::View);
}

Show LitView::wanted() const
{
    switch (mTool.viewMode())
    {
    case ViewMode::Normals:
        return Show::Normals;
    case ViewMode::Relief:
        return Show::Relief;
    default:
        return Show::Lit;
    }
}

void LitView::update()
{
    const int frame = mHost.currentFrame();
    if (frame != mShownFrame)
    {
        mShownFrame = frame;
        show(frame);
    }
    mSoon.start();
}

void LitView::show(int frame)
{
    const LookImage* kept = mKept.object(frame);
    if (!isLooking() || !kept || !mWorker.isCurrent(*kept) || !mAround.isKnown(frame))
    {
        mTool.clearPicture();
        return;
    }
    mTool.setSurroundings(mAround.below(frame), mAround.above(frame));
    mTool.setPicture(*kept);
}

void LitView::ask()
{
    const int frame = mHost.currentFrame();
    const std::optional<QTransform> canvasToWidget = mHost.canvasToWidget();
    if (!isLooking() || !canvasToWidget)
    {
        mWorker.stopLooking();
        mTool.clearPicture();
        return;
    }
    const FrameExport exported = mFeed.lastExport(frame);
    if (!mFeed.isFresh(frame))
        return;
    mTool.setFrame(exported);
    const QSize size = exported.image.isNull() ? mHost.canvasSize() : exported.image.size();
    const QTransform imageToWidget = exported.canvasToImage.inverted() * *canvasToWidget;
    const QRectF crop = cropInSight(imageToWidget, *mHost.canvas(), size);
    if (crop.isEmpty())
        mWorker.stopLooking();
    else
        mWorker.look(frame, wanted(), crop, deviceSize(imageToWidget, *mHost.canvas(), crop));
}

void LitView::take(const LookImage& image)
{
    if (!isLooking() || image.show != wanted())
        return;
    if (image.frame == mHost.currentFrame() && mAround.isKnown(image.frame))
    {
        mTool.setSurroundings(mAround.below(image.frame), mAround.above(image.frame));
        mTool.setPicture(image);
    }
    mKept.insert(image.frame, new LookImage(image), int(image.picture.sizeInBytes() / 1024) + 1);
}

} // namespace lampblack
