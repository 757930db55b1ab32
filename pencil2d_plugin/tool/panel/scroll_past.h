// Controls that let a turning wheel pass.
#pragma once

#include <QWidget>

namespace lampblack
{

/// While `control` (a slider, a field or a box) has no focus, a wheel over it scrolls what it lies in
/// rather than changing its value.
void scrollPast(QWidget* control);

} // namespace lampblack
