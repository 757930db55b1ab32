#include "tool/canvas/canvas_overlay.h"

#include "scene/timeline.h"
#include "tool/canvas/handle_painter.h"
#include "tool/depth/cut_painter.h"

#include <QEvent>
#include <QPaintEvent>

namespace lampblack
{

CanvasOverlay::CanvasOverlay(Host& host, const SceneDocument& document)
    : QWidget(host.canvas()), mHost(host), mDocument(document)
{
    setObjectName(QStringLiteral("lampblack.overlay"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    setFocusPolicy(Qt::NoFocus);
    hide();
    setGeometry(host.canvas()->rect());
    host.canvas()->installEventFilter(this);
    connect(&mLayer, &LightLayer::changed, this, qOverload<>(&QWidget::update));
    connect(&document, &SceneDocument::sceneChanged, this, &CanvasOverlay::updateHandles);
    connect(&document, &SceneDocument::selectionChanged, this, &CanvasOverlay::updateHandles);
    connect(&host, &Host::viewChanged, this, &CanvasOverlay::updateHandles);
    connect(&host, &Host::frameChanged, this,
            [this]
            {
                if (isKeyed(mDocument.scene()))
                    updateHandles();
            });
}

bool CanvasOverlay::showsPicture() const
{
    return !mComparing && mPicture.hasPicture() && mCanvasToWidget;
}

bool CanvasOverlay::showsStandIn() const
{
    return !mComparing && !mPicture.hasPicture() && !mPicture.isEmpty() && mCanvasToWidget;
}

void CanvasOverlay::setPicture(const PreviewImage& image, const QTransform& canvasToImage)
{
    const QRect before = mCanvasToWidget ? mPicture.bounds(*mCanvasToWidget) : QRect();
    mPicture.setPicture(image, canvasToImage);
    if (mCanvasToWidget)
        update(before.united(mPicture.bounds(*mCanvasToWidget)));
}

void CanvasOverlay::setStandIn(const PreviewImage& image, const QTransform& canvasToImage)
{
    const QRect before = mCanvasToWidget ? mPicture.bounds(*mCanvasToWidget) : QRect();
    mPicture.setStandIn(image, canvasToImage);
    if (mCanvasToWidget)
        update(before.united(mPicture.bounds(*mCanvasToWidget)));
}

void CanvasOverlay::setUnlitLayers(const FrameExport& below, const FrameExport& above)
{
    mPicture.setUnlitLayers(below, above);
    if (mCanvasToWidget)
        update(mPicture.bounds(*mCanvasToWidget));
}

void CanvasOverlay::clearPicture()
{
    if (mPicture.isEmpty())
        return;
    const QRect before = mCanvasToWidget ? mPicture.bounds(*mCanvasToWidget) : rect();
    mPicture.clear();
    mLayer.clear();
    update(before);
}

void CanvasOverlay::setComparing(bool comparing)
{
    if (comparing == mComparing)
        return;
    mComparing = comparing;
    update();
}

void CanvasOverlay::setPlaying(bool playing)
{
    if (playing == mPlaying)
        return;
    mPlaying = playing;
    update();
}

void CanvasOverlay::setDrawing(bool drawing)
{
    if (drawing == mDrawing)
        return;
    mDrawing = drawing;
    mLayer.clear();
    followPicture();
    update();
}

void CanvasOverlay::setDrawn(const FrameExport& drawn)
{
    mPicture.setDrawn(drawn);
    followPicture();
}

void CanvasOverlay::followPicture()
{
    if (mDrawing && mCanvasToWidget)
        mLayer.follow(mPicture, *mCanvasToWidget, size(), mHost.paper());
}

/// An animation that plays, or a frame whose light is not known as such, is shown as a picture.
bool CanvasOverlay::showsLayer() const
{
    return mDrawing && !mPlaying && mLayer.isReady(mHost.currentFrame());
}

void CanvasOverlay::setCutsShown(bool shown)
{
    mCutsShown = shown;
    update();
}

void CanvasOverlay::setCuts(const QVector<Cut>& cuts)
{
    mCuts = cuts;
    update();
}

void CanvasOverlay::setHoveredCut(int cut)
{
    if (cut == mHoveredCut)
        return;
    mHoveredCut = cut;
    update();
}

void CanvasOverlay::setCutStroke(const QPolygonF& line)
{
    if (line == mCutStroke)
        return;
    mCutStroke = line;
    update();
}

void CanvasOverlay::setBrush(const std::optional<BrushView>& brush)
{
    mBrush = brush;
    update();
}

void CanvasOverlay::setHovered(const Handle& handle)
{
    if (handle == mHovered)
        return;
    mHovered = handle;
    update(handlesRegion());
}

void CanvasOverlay::setTag(const QString& text, const QPointF& position)
{
    if (text == mTag && position == mTagPosition)
        return;
    QRect area;
    if (!mTag.isEmpty())
        area = tagBounds(font(), mTag, mTagPosition, size());
    mTag = text;
    mTagPosition = position;
    if (!mTag.isEmpty())
        area |= tagBounds(font(), mTag, mTagPosition, size());
    update(area.adjusted(-1, -1, 1, 1));
}

void CanvasOverlay::updateHandles()
{
    if (!isVisible())
        return;
    const std::optional<QTransform> transform = mHost.canvasToWidget();
    if (transform != mCanvasToWidget)
    {
        mCanvasToWidget = transform;
        followPicture();
        update();
    }
    const QRegion before = handlesRegion();
    mHandles = transform && transform->isInvertible() ? Handles(mDocument.scene(), mHost.currentFrame(),
                                                                mDocument.selectedLight(), *transform, size())
                                                      : Handles();
    update(before + handlesRegion());
}

void CanvasOverlay::paintEvent(QPaintEvent* event)
{
    if (!mCanvasToWidget || !mCanvasToWidget->isInvertible())
        return;
    QPainter painter(this);
    painter.setClipRegion(event->region());
    if (showsLayer())
        mLayer.paint(painter, *mCanvasToWidget);
    else if (showsPicture() || showsStandIn())
    {
        mPicture.paint(painter, *mCanvasToWidget, size(), devicePixelRatioF(), mHost.paper());
        paintGuides(painter);
    }
    if (mPlaying || mDrawing)
        return;
    if (mBrush)
    {
        paintBrush(painter, *mBrush, *mCanvasToWidget);
    }
    else if (mCutsShown)
    {
        paintCuts(painter, mCuts, mHoveredCut, *mCanvasToWidget);
        paintStroke(painter, mCutStroke, *mCanvasToWidget);
    }
    else
    {
        paintHandles(painter, mHandles, mHovered);
    }
    if (!mTag.isEmpty())
        paintTag(painter, mTag, mTagPosition, size());
}

/// Where the picture covers them.
void CanvasOverlay::paintGuides(QPainter& painter) const
{
    painter.save();
    painter.setClipPath(mPicture.outline(*mCanvasToWidget), Qt::IntersectClip);
    mHost.paintGuides(&painter);
    painter.restore();
}

bool CanvasOverlay::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == parent() && event->type() == QEvent::Resize)
    {
        setGeometry(parentWidget()->rect());
        updateHandles();
    }
    return QWidget::eventFilter(watched, event);
}

QRegion CanvasOverlay::handlesRegion() const
{
    return mHandles.region() & rect();
}

} // namespace lampblack
