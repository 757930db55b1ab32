#include "tool/canvas/canvas_input.h"

#include "scene/timeline.h"

#include <QIcon>

namespace lampblack
{

namespace
{

constexpr double DragThreshold = 3; // pixels; less is a click
constexpr int TagMs = 900;
constexpr qint64 MaxZoomPauseMs = 500;
constexpr double NotchUnits = 120;

QCursor lampCursor()
{
    const QIcon icon(QStringLiteral(":/lampblack/lamp-cursor.svg"));
    return QCursor(icon.pixmap(32, 32), 4, 4);
}

} // namespace

CanvasInput::CanvasInput(Host& host, SceneDocument& document, CanvasOverlay& overlay)
    : PointerFilter(host, &overlay), mDocument(document), mOverlay(overlay), mLampCursor(lampCursor())
{
    mTagTimer.setSingleShot(true);
    mTagTimer.setInterval(TagMs);
    connect(&mTagTimer, &QTimer::timeout, &overlay, [&overlay] { overlay.setTag(QString(), QPointF()); });
}

void CanvasInput::handleListening()
{
    if (isListening())
    {
        updateCursor();
        return;
    }
    mDrag.reset();
    mSwallowRelease = false;
    setPicking(false);
    mOverlay.setHovered({});
    mOverlay.setTag(QString(), QPointF());
    Q_EMIT pointerLeft();
}

void CanvasInput::setPicking(bool picking)
{
    if (picking == mPicking)
        return;
    mPicking = picking;
    if (isListening())
        updateCursor();
    Q_EMIT pickingChanged(picking);
}

void CanvasInput::cancelDrag()
{
    if (!mDrag)
        return;
    if (mHasMoved)
        mDocument.edit(mDrag->undoText(), mDrag->restored(mDocument.scene()), mDrag->gesture());
    mDrag.reset();
    mSwallowRelease = true;
    mOverlay.setTag(QString(), QPointF());
    updateCursor();
}

void CanvasInput::handleLeave()
{
    if (!mDrag)
        mOverlay.setHovered({});
    Q_EMIT pointerLeft();
}

bool CanvasInput::handlePress(const Pointer& pointer)
{
    if (mDrag || !mOverlay.canvasToWidget())
        return mDrag.has_value();
    if (pointer.button == Qt::RightButton)
    {
        setPicking(false);
        mSwallowRelease = true;
        const Handle handle = mOverlay.handles().at(pointer.position);
        if (handle.light >= 0)
            mDocument.selectLight(handle.light);
        Q_EMIT menuRequested(toCanvas(pointer.position), pointer.global, handle);
        return true;
    }
    if (pointer.button != Qt::LeftButton)
        return false;
    host().canvas()->setFocus(Qt::MouseFocusReason);
    if (mPicking)
    {
        mSwallowRelease = true;
        setPicking(false);
        Q_EMIT colourPicked(toCanvas(pointer.position));
        return true;
    }
    const Handle handle = mOverlay.handles().at(pointer.position);
    if (handle.part == HandlePart::None)
    {
        mSwallowRelease = true;
        return true; // the lamp does not draw
    }
    if (handle.light >= 0)
        mDocument.selectLight(handle.light);
    mDrag.emplace(handle, pointer.modifiers.testFlag(Qt::AltModifier), pointer.position, mDocument.scene(),
                  host().currentFrame(), mOverlay.handles(), *mOverlay.canvasToWidget());
    mPressPosition = pointer.position;
    mHasMoved = false;
    updateCursor();
    return true;
}

bool CanvasInput::handleMove(const Pointer& pointer)
{
    if (mDrag)
    {
        if (pointer.buttons.testFlag(Qt::LeftButton))
            continueDrag(pointer);
        else
            handleRelease({pointer.position, pointer.global, Qt::LeftButton, {}, pointer.modifiers, false});
        return true;
    }
    if (pointer.buttons != Qt::NoButton)
        return mSwallowRelease;
    mOverlay.setHovered(mPicking ? Handle() : mOverlay.handles().at(pointer.position));
    updateCursor();
    if (mOverlay.canvasToWidget())
        Q_EMIT pointerMoved(toCanvas(pointer.position));
    return false;
}

bool CanvasInput::handleRelease(const Pointer& pointer)
{
    if (mDrag && pointer.button == Qt::LeftButton)
    {
        mDrag.reset();
        mTagTimer.start();
        mOverlay.setHovered(mOverlay.handles().at(pointer.position));
        updateCursor();
        return true;
    }
    if (mDrag)
        return true;
    const bool isOurs = mSwallowRelease;
    mSwallowRelease = false;
    return isOurs;
}

void CanvasInput::continueDrag(const Pointer& pointer)
{
    if (!mHasMoved && QLineF(mPressPosition, pointer.position).length() < DragThreshold)
        return;
    mHasMoved = true;
    const bool constrain = pointer.modifiers.testFlag(Qt::ShiftModifier);
    mDocument.edit(mDrag->undoText(), mDrag->moved(mDocument.scene(), pointer.position, constrain),
                   mDrag->gesture());
    showValueTag(mDrag->handle(), pointer.position, mDrag->kind());
}

bool CanvasInput::handleWheel(QWheelEvent& wheel)
{
    const Handle handle = mOverlay.handles().at(wheel.position());
    const double notches = wheel.angleDelta().y() / NotchUnits;
    if (mDrag)
        return true;
    // If a light comes under the pointer while the artist zooms, the wheel goes on zooming.
    const bool isZooming = mSinceZoom.isValid() && mSinceZoom.elapsed() < MaxZoomPauseMs;
    if (handle.part == HandlePart::None || isZooming || wheel.modifiers().testFlag(Qt::ControlModifier))
    {
        mSinceZoom.start();
        return false;
    }
    const bool isFloor = handle.part == HandlePart::Floor;
    if (!isFloor)
        mDocument.selectLight(handle.light);
    const QString text = isFloor ? tr("Pitch Floor") : tr("Change Light Height");
    const int frame = host().currentFrame();
    const bool fine = wheel.modifiers().testFlag(Qt::ShiftModifier);
    mDocument.edit(text, turnedByWheel(mDocument.scene(), frame, handle, notches, fine),
                   mWheelGestures.gestureFor(
                       QStringLiteral("%1 %2 %3").arg(int(handle.part)).arg(handle.light).arg(frame)));
    showValueTag(handle, wheel.position(), isFloor ? Drag::Kind::FloorPitch : Drag::Kind::LightHeight);
    mTagTimer.start();
    return true;
}

void CanvasInput::showValueTag(const Handle& handle, const QPointF& position, Drag::Kind kind)
{
    const Scene scene = sceneAt(mDocument.scene(), host().currentFrame());
    const AreaLight light = scene.lights.value(handle.light);
    const Floor floor = scene.floor.value_or(Floor());
    QString text;
    switch (kind)
    {
    case Drag::Kind::LightPlace:
        break; // no tag: the picture shows it
    case Drag::Kind::LightHeight:
        text = light.z < 0 ? tr("Behind the paper: %1").arg(qRound(-light.z))
                           : tr("Height: %1").arg(qRound(light.z));
        break;
    case Drag::Kind::LightSize:
        text = tr("Size: %1").arg(qRound(light.size));
        break;
    case Drag::Kind::FloorPlace:
        text = tr("Floor: %1").arg(qRound(floor.y));
        break;
    case Drag::Kind::FloorPitch:
        text = tr("Pitch: %1°").arg(qRound(floor.pitch));
        break;
    }
    mTagTimer.stop();
    mOverlay.setTag(text, position);
}

void CanvasInput::updateCursor()
{
    QCursor cursor = mLampCursor;
    const HandlePart part = mDrag ? mDrag->handle().part : mOverlay.hovered().part;
    if (mPicking)
        cursor = Qt::CrossCursor;
    else if (part == HandlePart::Light || part == HandlePart::Size)
        cursor = Qt::ArrowCursor; // the lamp cursor would hide the light
    else if (part == HandlePart::Height || part == HandlePart::Floor)
        cursor = Qt::SizeVerCursor;
    showCursor(cursor);
}

QPointF CanvasInput::toCanvas(const QPointF& position) const
{
    return mOverlay.canvasToWidget()->inverted().map(position);
}

} // namespace lampblack
