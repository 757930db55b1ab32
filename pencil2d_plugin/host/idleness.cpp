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

bool Idleness::isIdle() const
{
    return mWork == 0 && !mPenDown && QGuiApplication::mouseButtons() == Qt::NoButton &&
           QApplication::activeModalWidget() == nullptr && QApplication::activePopupWidget() == nullptr &&
           (!mSinceKey.isValid() || mSinceKey.elapsed() > TypingPauseMs);
}

bool Idleness::eventFilter(QObject* watched, QEvent* event)
{
    if (mWork > 0)
        return false;
    switch (event->type())
    {
    case QEvent::TabletPress:
        mPenDown = true;
        break;
    case QEvent::TabletRelease:
        mPenDown = false;
        Q_EMIT released(watched);
        break;
    case QEvent::TabletLeaveProximity:
        mPenDown = false;
        break;
    case QEvent::MouseButtonRelease:
        if (watched->isWidgetType())
            Q_EMIT released(watched);
        break;
    case QEvent::KeyPress:
        mSinceKey.start();
        break;
    case QEvent::KeyRelease:
        if (watched->isWidgetType())
            Q_EMIT keyReleased(static_cast<QKeyEvent*>(event)->key());
        break;
    default:
        break;
    }
    return false;
}

} // namespace lampblack
