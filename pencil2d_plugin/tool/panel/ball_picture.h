// A ball with an outline, as a picture of a light or a look.
#pragma once

#include <QColor>
#include <QPixmap>
#include <QVector3D>

#include <functional>

namespace lampblack
{

/// `colourOf` gives the colour where the ball's surface has a normal: x right, y down, z to the viewer.
QPixmap ballPicture(int side, double pixelRatio, const std::function<QColor(const QVector3D&)>& colourOf);

} // namespace lampblack
