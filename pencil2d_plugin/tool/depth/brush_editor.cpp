#include "tool/depth/brush_editor.h"

#include "tool/depth/brush_bar.h"
#include "tool/depth/cuts.h"

#include <QLineF>

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{

constexpr double Reach = 8; // widget pixels, as the next
constexpr double PointSpacing = 3;
constexpr double LeastTurn = 16;
constexpr double NotchUnits = 120;
constexpr double RadiusNotch = 1.15;
constexpr double AmountNotch = 0.05;
constexpr double UsualRadius = 0.04; // shares of the canvas's longer side
constexpr double LargestRadius = 0.5;
constexpr double UsualAmount = 0.4;
constexpr double UsualTurn = 0.25;
constexpr int TagMs = 1200;

} // namespace

BrushEditor::BrushEditor(Host& host, SceneDocument& document, CanvasOverlay& overlay)
    : PointerFilter(host, &overlay), mDocument(document), mOverlay(overlay), mRadiusShare(UsualRadius)
{
    mTagTimer.setSingleShot(true);
    mTagTimer.setInterval(TagMs);
    connect(&mTagTimer, &QTimer::timeout, this, [this] { mOverlay.setTag(QString(), {}); });
    connect(&document, &SceneDocument::sceneChanged, this, &BrushEditor::refresh);
    connect(&host, &Host::frameChanged, this,
            [this]
            {
                cancelStroke();
                refresh();
            });
}

void BrushEditor::setBrush(Brush brush)
{
    if (mView.brush.brush != brush)
        mView.brush.amount = brush == Brush::Turn ? UsualTurn : UsualAmount;
    mView.brush.brush = brush;
    show();
}

void BrushEditor::cancelStroke()
{
    mView.drawn.clear();
    show();
}

void BrushEditor::removeStroke(int stroke)
{
    mDocument.edit(tr("Remove Stroke"), withoutStroke(mDocument.scene(), stroke));
}

void BrushEditor::handleListening()
{
    mView.drawn.clear();
    mView.pointer.reset();
    mHovered = -1;
    mSwallowRelease = false;
    if (!isListening())
    {
        mTagTimer.stop();
        mOverlay.setTag(QString(), {});
        mOverlay.setBrush({});
        return;
    }
    showCursor(Qt::CrossCursor);
    host().showStatus(tr("Drag to shape the surface. Wheel: radius. Shift and wheel: strength. Right-click: "
                         "more"));
    refresh();
}

void BrushEditor::refresh()
{
    if (!isListening())
        return;
    mView.brush.radius = std::max(1.0, mRadiusShare * longerSide());
    if (mHovered >= mDocument.scene().depth.strokes.size())
        mHovered = -1;
    show();
}

void BrushEditor::show()
{
    if (!isListening())
        return;
    const QVector<DepthStroke>& strokes = mDocument.scene().depth.strokes;
    const int frame = host().currentFrame();
    mView.strokes.clear();
    mView.hovered = -1;
    for (int i = 0; i < strokes.size(); ++i)
    {
        if (strokes[i].frame != frame)
            continue;
        if (i == mHovered)
            mView.hovered = mView.strokes.size();
        mView.strokes.append(strokes[i]);
    }
    mOverlay.setBrush(mView);
}

void BrushEditor::hover(const Pointer& pointer)
{
    mView.pointer = toCanvas(pointer.position);
    mHovered = isDrawing() ? -1
                           : strokeUnder(mDocument.scene(), host().currentFrame(), *mOverlay.canvasToWidget(),
                                         pointer.position, Reach);
    show();
}

void BrushEditor::handleLeave()
{
    mView.pointer.reset();
    if (!isDrawing())
        mHovered = -1;
    show();
}

bool BrushEditor::handlePress(const Pointer& pointer)
{
    if (!mOverlay.canvasToWidget() || isDrawing())
        return isDrawing();
    hover(pointer);
    if (pointer.button == Qt::RightButton)
    {
        mSwallowRelease = true;
        Q_EMIT menuRequested(mHovered, pointer.global);
        return true;
    }
    if (pointer.button != Qt::LeftButton)
        return false;
    host().canvas()->setFocus(Qt::MouseFocusReason);
    mView.drawn.append(toCanvas(pointer.position));
    hover(pointer);
    return true;
}

bool BrushEditor::handleMove(const Pointer& pointer)
{
    if (!mOverlay.canvasToWidget())
        return false;
    if (!isDrawing() && pointer.buttons != Qt::NoButton)
        return mSwallowRelease;
    const bool isOurs = isDrawing();
    if (isOurs)
    {
        const QPointF last = mOverlay.canvasToWidget()->map(mView.drawn.last());
        if (QLineF(last, pointer.position).length() >= PointSpacing)
            mView.drawn.append(toCanvas(pointer.position));
    }
    hover(pointer);
    return isOurs;
}

bool BrushEditor::handleRelease(const Pointer& pointer)
{
    if (isDrawing() && pointer.button == Qt::LeftButton)
    {
        addStroke();
        cancelStroke();
        return true;
    }
    const bool isOurs = isDrawing() || mSwallowRelease;
    mSwallowRelease = false;
    return isOurs;
}

bool BrushEditor::handleWheel(QWheelEvent& wheel)
{
    if (!mOverlay.canvasToWidget() || wheel.modifiers().testFlag(Qt::ControlModifier))
        return false;
    // Some systems turn the wheel sideways while Shift is held.
    const QPoint turned = wheel.angleDelta();
    const double notches = (turned.y() != 0 ? turned.y() : turned.x()) / NotchUnits;
    QString tag;
    if (wheel.modifiers().testFlag(Qt::ShiftModifier))
    {
        double& amount = mView.brush.amount;
        amount = std::clamp(amount + AmountNotch * notches, AmountNotch, 1.0);
        tag = tr("Strength: %1 %").arg(std::lround(100 * amount));
    }
    else
    {
        const double least = 1 / std::max(1.0, longerSide());
        mRadiusShare = std::clamp(mRadiusShare * std::pow(RadiusNotch, notches), least, LargestRadius);
        mView.brush.radius = std::max(1.0, mRadiusShare * longerSide());
        tag = tr("Radius: %1").arg(std::lround(mView.brush.radius));
    }
    mView.pointer = toCanvas(wheel.position());
    mOverlay.setTag(tag, wheel.position());
    mTagTimer.start();
    show();
    return true;
}

void BrushEditor::addStroke()
{
    const Scene& scene = mDocument.scene();
    const Brush brush = mView.brush.brush;
    if (brush == Brush::Turn && lengthOf(mOverlay.canvasToWidget()->map(mView.drawn)) < LeastTurn)
    {
        host().showStatus(tr("Drag: the surface turns to where the stroke goes"));
        return;
    }
    if (!hasRoomForStroke(scene))
    {
        host().showStatus(
            tr("A project has at most %1 strokes of the brush. Remove some first.").arg(MaxStrokes));
        return;
    }
    mDocument.edit(nameOf(brush), withStroke(scene, host().currentFrame(), mView.drawn, mView.brush));
}

double BrushEditor::longerSide() const
{
    return std::max(mDocument.scene().canvas.width, mDocument.scene().canvas.height);
}

QPointF BrushEditor::toCanvas(const QPointF& position) const
{
    return mOverlay.canvasToWidget()->inverted().map(position);
}

} // namespace lampblack
