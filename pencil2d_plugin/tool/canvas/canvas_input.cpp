#include "tool/canvas/canvas_input.h"

#include "scene/timeline.h"

#include <QHoverEvent>
#include <QIcon>
#include <QMouseEvent>
#include <QTabletEvent>
#include <QWheelEvent>

namespace lampblack
{

namespace
{

constexpr double Threshold = 3; // a shaky click is no drag
constexpr int TagMs = 900;
constexpr qint64 ZoomPauseMs = 500;
constexpr double NotchUnits = 120;

QCursor lampCursor()
{
    const QIcon icon(QStringLiteral(":/lampblack/lamp-cursor.svg"));
    return QCursor(icon.pixmap(32, 32), 4, 4);
}

} // namespace

CanvasInput::CanvasInput(Host& host, SceneDocument& document, CanvasOverlay& overlay)
    : QObject(&overlay), mHost(host), mDocument(document), mOverlay(overlay), mLampCursor(lampCursor())
{
    mTagTimer.setSingleShot(true);
    mTagTimer.setInterval(TagMs);
    connect(&mTagTimer, &QTimer::timeout, &overlay, [&overlay] { overlay.setTag(QString(), QPointF()); });
    host.canvas()->installEventFilter(this);
}

CanvasInput::~CanvasInput()
{
    restoreCursor();
}

void CanvasInput::setListening(bool listening)
{
    if (listening == mListening)
        return;
    mListening = listening;
    if (listening)
    {
        showCursor();
        return;
    }
    mDrag.reset();
    mSwallowRelease = false;
    mPenDown = false;
    setPicking(false);
    mOverlay.setHovered({});
    mOverlay.setTag(QString(), QPointF());
    restoreCursor();
    Q_EMIT left();
}

void CanvasInput::setPicking(bool picking)
{
    if (picking == mPicking)
        return;
    mPicking = picking;
    if (mListening)
        showCursor();
    Q_EMIT pickingChanged(picking);
}

void CanvasInput::cancelDrag()
{
    if (!mDrag)
        return;
    if (mMoved)
        mDocument.edit(mDrag->text(), mDrag->restored(mDocument.scene()), mDrag->gesture());
    mDrag.reset();
    mSwallowRelease = true;
    mOverlay.setTag(QString(), QPointF());
    showCursor();
}

bool CanvasInput::eventFilter(QObject* watched, QEvent* event)
{
    if (!mListening || watched != mHost.canvas())
        return QObject::eventFilter(watched, event);
    switch (event->type())
    {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseMove:
    case QEvent::MouseButtonRelease:
        return mouse(event);
    case QEvent::TabletPress:
    case QEvent::TabletMove:
    case QEvent::TabletRelease:
        return tablet(event);
    case QEvent::Wheel:
        return wheel(event);
    case QEvent::Leave:
        if (!mDrag)
            mOverlay.setHovered({});
        Q_EMIT left();
        return false;
    case QEvent::ContextMenu:
        event->accept();
        return true; // the press of the right button has opened ours
    default:
        return false;
    }
}

bool CanvasInput::mouse(QEvent* event)
{
    if (mPenDown) // the window system may follow a pen with a mouse of its own
        return true;
    const auto& mouse = static_cast<QMouseEvent&>(*event);
    const Pointer pointer{mouse.localPos(), mouse.globalPos(), mouse.button(), mouse.buttons(),
                          mouse.modifiers()};
    bool ours = false;
    if (event->type() == QEvent::MouseMove)
        ours = move(pointer);
    else if (event->type() == QEvent::MouseButtonRelease)
        ours = release(pointer);
    else
        ours = press(pointer);
    if (ours)
        event->accept();
    return ours;
}

bool CanvasInput::tablet(QEvent* event)
{
    const auto& pen = static_cast<QTabletEvent&>(*event);
    const Pointer pointer{pen.posF(), pen.globalPos(), pen.button(), pen.buttons(), pen.modifiers()};
    bool ours = false;
    if (event->type() == QEvent::TabletMove)
    {
        ours = move(pointer);
    }
    else if (event->type() == QEvent::TabletRelease)
    {
        ours = release(pointer);
        mPenDown = false;
    }
    else
    {
        ours = press(pointer);
        mPenDown = ours;
    }
    if (ours)
        event->accept();
    return ours;
}

bool CanvasInput::press(const Pointer& pointer)
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
        Q_EMIT menuRequested(onCanvas(pointer.position), pointer.global, handle);
        return true;
    }
    if (pointer.button != Qt::LeftButton)
        return false;
    mHost.canvas()->setFocus(Qt::MouseFocusReason);
    if (mPicking)
    {
        mSwallowRelease = true;
        setPicking(false);
        Q_EMIT picked(onCanvas(pointer.position));
        return true;
    }
    const Handle handle = mOverlay.handles().at(pointer.position);
    if (handle.part == HandlePart::None)
    {
        mSwallowRelease = true;
        return true; // with the lamp in hand nothing is drawn
    }
    if (handle.light >= 0)
        mDocument.selectLight(handle.light);
    mDrag.emplace(handle, pointer.modifiers.testFlag(Qt::AltModifier), pointer.position, mDocument.scene(),
                  mHost.currentFrame(), mOverlay.handles(), *mOverlay.canvasToWidget());
    mPressed = pointer.position;
    mMoved = false;
    showCursor();
    return true;
}

bool CanvasInput::move(const Pointer& pointer)
{
    if (mDrag)
    {
        if (pointer.buttons.testFlag(Qt::LeftButton))
            drag(pointer);
        else
            release({pointer.position, pointer.global, Qt::LeftButton, {}, pointer.modifiers});
        return true;
    }
    if (pointer.buttons != Qt::NoButton)
        return mSwallowRelease;
    mOverlay.setHovered(mPicking ? Handle() : mOverlay.handles().at(pointer.position));
    showCursor();
    if (mOverlay.canvasToWidget())
        Q_EMIT pointed(onCanvas(pointer.position));
    return false;
}

bool CanvasInput::release(const Pointer& pointer)
{
    if (mDrag && pointer.button == Qt::LeftButton)
    {
        mDrag.reset();
        mTagTimer.start();
        mOverlay.setHovered(mOverlay.handles().at(pointer.position));
        showCursor();
        return true;
    }
    if (mDrag)
        return true;
    const bool ours = mSwallowRelease;
    mSwallowRelease = false;
    return ours;
}

void CanvasInput::drag(const Pointer& pointer)
{
    if (!mMoved && QLineF(mPressed, pointer.position).length() < Threshold)
        return;
    mMoved = true;
    const bool constrain = pointer.modifiers.testFlag(Qt::ShiftModifier);
    mDocument.edit(mDrag->text(), mDrag->moved(mDocument.scene(), pointer.position, constrain),
                   mDrag->gesture());
    tell(mDrag->handle(), pointer.position, mDrag->kind());
}

bool CanvasInput::wheel(QEvent* event)
{
    auto& wheel = static_cast<QWheelEvent&>(*event);
    const Handle handle = mOverlay.handles().at(wheel.position());
    const double notches = wheel.angleDelta().y() / NotchUnits;
    if (mDrag)
        return true;
    // A light that comes under the pointer while the artist zooms must not end the zoom.
    const bool isZooming = mZoomed.isValid() && mZoomed.elapsed() < ZoomPauseMs;
    if (handle.part == HandlePart::None || isZooming || wheel.modifiers().testFlag(Qt::ControlModifier))
    {
        mZoomed.start();
        return false;
    }
    wheel.accept();
    const bool isFloor = handle.part == HandlePart::Floor;
    if (!isFloor)
        mDocument.selectLight(handle.light);
    const QString text = isFloor ? tr("Pitch Floor") : tr("Change Light Height");
    const int frame = mHost.currentFrame();
    const bool fine = wheel.modifiers().testFlag(Qt::ShiftModifier);
    mDocument.edit(
        text, turned(mDocument.scene(), frame, handle, notches, fine),
        mWheelRun.of(QStringLiteral("%1 %2 %3").arg(int(handle.part)).arg(handle.light).arg(frame)));
    tell(handle, wheel.position(), isFloor ? Drag::Kind::FloorPitch : Drag::Kind::LightHeight);
    mTagTimer.start();
    return true;
}

void CanvasInput::tell(const Handle& handle, const QPointF& beside, Drag::Kind kind)
{
    const Scene scene = sceneAt(mDocument.scene(), mHost.currentFrame());
    const AreaLight light = scene.lights.value(handle.light);
    const Floor floor = scene.floor.value_or(Floor());
    QString text;
    switch (kind)
    {
    case Drag::Kind::LightPlace:
        break; // the picture says it better
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
    mOverlay.setTag(text, beside);
}

void CanvasInput::showCursor()
{
    QCursor cursor = mLampCursor;
    const HandlePart part = mDrag ? mDrag->handle().part : mOverlay.hovered().part;
    if (mPicking)
        cursor = Qt::CrossCursor;
    else if (part == HandlePart::Light || part == HandlePart::Size)
        cursor = Qt::ArrowCursor; // a hand would hide the light
    else if (part == HandlePart::Height || part == HandlePart::Floor)
        cursor = Qt::SizeVerCursor;
    QWidget& canvas = *mHost.canvas();
    if (!mCursorBefore)
        mCursorBefore = canvas.cursor();
    if (canvas.cursor() != cursor)
        canvas.setCursor(cursor);
    mCursorShown = cursor;
}

void CanvasInput::restoreCursor()
{
    // The tool that follows may have set its own already: that one stays.
    if (mCursorBefore && mHost.canvas() && mHost.canvas()->cursor() == mCursorShown)
        mHost.canvas()->setCursor(*mCursorBefore);
    mCursorBefore.reset();
}

QPointF CanvasInput::onCanvas(const QPointF& position) const
{
    return mOverlay.canvasToWidget()->inverted().map(position);
}

} // namespace lampblack
