#include "host/idleness.h"

#include <QApplication>
#include <QKeyEvent>

namespace lampblack
{

namespace
{
constexpr qint64 TypingPauseMs = 400;
}

Idleness::Idleness(QObject* parent) : QObject(parent)
{
    QCoreApplication::instance()->installEventFilter(this);
}

bool Idleness::areHandsOff() const
{
    return !mPenDown && QGuiApplication::mouseButtons() == Qt::NoButton;
}

bool Idleness::isIdle() const
{
    return mWork == 0 && areHandsOff() && QApplication::activeModalWidget() == nullptr &&
           QApplication::activePopupWidget() == nullptr &&
           (!mSinceKey.isValid() || mSinceKey.elapsed() > TypingPauseMs);
}

bool Idleness::eventFilter(QObject* watched, QEvent* event)
{
    // Events that we send ourselves are not the artist's; those of the window system always are.
    if (mWork > 0 && !event->spontaneous())
        return false;
    switch (event->type())
    {
    case QEvent::TabletPress:
        mPenDown = true;
        break;
    case QEvent::TabletRelease:
        mPenDown = false;
        if (watched->isWidgetType())
            Q_EMIT released(watched, {});
        break;
    case QEvent::TabletLeaveProximity:
        mPenDown = false;
        break;
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
        if (watched->isWidgetType())
        {
            const QPoint at = static_cast<QMouseEvent*>(event)->pos();
            mGesture = {at, at, event->type() == QEvent::MouseButtonDblClick};
        }
        break;
    case QEvent::MouseButtonRelease:
        if (watched->isWidgetType())
        {
            mGesture.to = static_cast<QMouseEvent*>(event)->pos();
            Q_EMIT released(watched, mGesture);
        }
        break;
    case QEvent::KeyPress:
        mSinceKey.start();
        break;
    case QEvent::KeyRelease:
        if (auto* key = static_cast<QKeyEvent*>(event);
            watched->isWidgetType() && (key->modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) == 0)
        {
            Q_EMIT keyReleased(key->key());
        }
        break;
    default:
        break;
    }
    return false;
}

} // namespace lampblack
