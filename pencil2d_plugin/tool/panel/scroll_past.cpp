#include "tool/panel/scroll_past.h"

#include <QEvent>

namespace lampblack
{

namespace
{

class WheelFilter : public QObject
{
public:
    explicit WheelFilter(QWidget* control) : QObject(control) { control->installEventFilter(this); }

    bool eventFilter(QObject* watched, QEvent* event) override
    {
        if (event->type() != QEvent::Wheel || static_cast<QWidget*>(watched)->hasFocus())
            return false;
        event->ignore(); // Qt offers it to the parent
        return true;
    }
};

} // namespace

void scrollPast(QWidget* control)
{
    control->setFocusPolicy(Qt::StrongFocus); // a wheel alone must not bring the focus
    new WheelFilter(control);
}

} // namespace lampblack
