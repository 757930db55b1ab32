// Lets the wheel scroll the panel over controls without focus.
#pragma once

#include <QWidget>

namespace lampblack
{

/// While `control` (a slider, a field or a box) has no focus, the wheel over it scrolls the panel and does
/// not change the value.
void ignoreWheelWithoutFocus(QWidget* control);

} // namespace lampblack
