// The frame of a camera, as the camera tool of Pencil2D 0.7 draws it over the canvas.
#pragma once

#include "host/view_reader.h"

namespace lampblack
{

/// The view of a camera (Pencil2D's canvas to picture, both with origins at the centre) whose frame has these
/// corners on the canvas widget, from the top left clockwise, when the view onto the widget is `widget`. No
/// value if no view has such a frame.
std::optional<QTransform> viewOfFrame(const QPolygonF& corners, const QTransform& widget,
                                      const QSize& picture);

/// The view of the camera whose layer is the current one, while the camera tool is in use.
std::optional<QTransform> readCameraFrame(QWidget* canvas, const QTransform& widget, const QSize& picture);

} // namespace lampblack
