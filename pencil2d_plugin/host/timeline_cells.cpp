#include "host/timeline_cells.h"

#include "host/parts.h"

#include <QCoreApplication>
#include <QMouseEvent>
#include <QScrollBar>

namespace lampblack
{

ScrolledCells::ScrolledCells(QWidget* cells, Qt::Orientation orientation, int place)
    : mCells(cells), mOrientation(orientation)
{
    scrollTo(place);
}

ScrolledCells::~ScrolledCells()
{
    if (mCells == nullptr)
        return;
    int place = 0;
    const auto bars = mCells->window()->findChildren<QScrollBar*>();
    for (const QScrollBar* bar : bars)
    {
        if (bar->orientation() == mOrientation && isClass(bar->parentWidget()->parentWidget(), "TimeLine"))
            place = bar->value();
    }
    scrollTo(place);
}

void ScrolledCells::scrollTo(int place) const
{
    const char* slot = mOrientation == Qt::Vertical ? "vScrollChange" : "hScrollChange";
    QMetaObject::invokeMethod(mCells, slot, Qt::DirectConnection, Q_ARG(int, place));
}

void sendMouse(QWidget* widget, QEvent::Type type, const QPoint& at, Qt::MouseButtons buttons)
{
    QMouseEvent event(type, at, widget->mapToGlobal(at), Qt::LeftButton, buttons, Qt::NoModifier);
    QCoreApplication::sendEvent(widget, &event);
}

void sendClick(QWidget* widget, const QPoint& at)
{
    sendMouse(widget, QEvent::MouseButtonPress, at, Qt::LeftButton);
    sendMouse(widget, QEvent::MouseButtonRelease, at, Qt::NoButton);
}

} // namespace lampblack
