#include "tool/canvas/pointer_filter.h"

#include <QMouseEvent>
#include <QTabletEvent>

namespace lampblack
{

PointerFilter::PointerFilter(Host& host, QObject* parent) : QObject(parent), mHost(host)
{
    host.canvas()->installEventFilter(this);
}

PointerFilter::~PointerFilter()
{
    restoreCursor();
}

void PointerFilter::setListening(bool listening)
{
    if (listening == mListening)
        return;
    mListening = listening;
    mPenDown = false;
    handleListening();
    if (!listening)
        restoreCursor();
}

bool PointerFilter::eventFilter(QObject* watched, QEvent* event)
{
    if (!mListening || watched != mHost.canvas())
        return QObject::eventFilter(watched, event);
    bool isOurs = false;
    switch (event->type())
    {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
    case QEvent::MouseMove:
    case QEvent::MouseButtonRelease:
        isOurs = handleMouse(*event);
        break;
    case QEvent::TabletPress:
    case QEvent::TabletMove:
    case QEvent::TabletRelease:
        isOurs = handleTablet(*event);
        break;
    case QEvent::Wheel:
        isOurs = handleWheel(static_cast<QWheelEvent&>(*event));
        break;
    case QEvent::ContextMenu:
        isOurs = true; // our menu was opened when the right button was pressed
        break;
    case QEvent::Leave:
        handleLeave();
        break;
    default:
        break;
    }
    if (isOurs)
        event->accept();
    return isOurs;
}

bool PointerFilter::handleMouse(QEvent& event)
{
    if (mPenDown) // the window system may send mouse events for the pen too
        return true;
    const auto& mouse = static_cast<QMouseEvent&>(event);
    const Pointer pointer{mouse.localPos(), mouse.globalPos(), mouse.button(),
                          mouse.buttons(),  mouse.modifiers(), false};
    if (event.type() == QEvent::MouseMove)
        return handleMove(pointer);
    return event.type() == QEvent::MouseButtonRelease ? handleRelease(pointer) : handlePress(pointer);
}

bool PointerFilter::handleTablet(QEvent& event)
{
    const auto& pen = static_cast<QTabletEvent&>(event);
    const Pointer pointer{pen.posF(), pen.globalPos(), pen.button(), pen.buttons(), pen.modifiers(), true};
    if (event.type() == QEvent::TabletMove)
        return handleMove(pointer);
    if (event.type() == QEvent::TabletPress)
    {
        const bool isOurs = handlePress(pointer);
        mPenDown = isOurs;
        return isOurs;
    }
    const bool isOurs = handleRelease(pointer);
    mPenDown = false;
    return isOurs;
}

void PointerFilter::showCursor(const QCursor& cursor)
{
    QWidget& canvas = *mHost.canvas();
    if (!mCursorBefore)
        mCursorBefore = canvas.cursor();
    if (canvas.cursor() != cursor)
        canvas.setCursor(cursor);
    mCursorShown = cursor;
}

void PointerFilter::restoreCursor()
{
    // The next tool may have set its cursor already.
    if (mCursorBefore && mHost.canvas() && mHost.canvas()->cursor() == mCursorShown)
        mHost.canvas()->setCursor(*mCursorBefore);
    mCursorBefore.reset();
}

} // namespace lampblack
