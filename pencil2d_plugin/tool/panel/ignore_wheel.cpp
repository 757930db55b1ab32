#include "tool/panel/ignore_wheel.h"

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
        event->ignore(); // Qt passes it to the parent
        return true;
    }
};

} // namespace

void ignoreWheelWithoutFocus(QWidget* control)
{
    control->setFocusPolicy(Qt::StrongFocus); // the wheel must not give it the focus
    new WheelFilter(control);
}

} // namespace lampblack
