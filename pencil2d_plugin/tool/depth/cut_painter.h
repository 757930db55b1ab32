// Paints the cuts over the picture of the depth.
#pragma once

#include "tool/depth/cuts.h"

#include <QPainter>

namespace lampblack
{

/// Everything in widget coordinates but the cuts. The side in front has teeth. `hovered` is an index or -1.
void paintCuts(QPainter& painter, const QVector<Cut>& cuts, int hovered, const QTransform& canvasToWidget);

/// A line that is being drawn, canvas pixels; its left side is in front.
void paintStroke(QPainter& painter, const QPolygonF& stroke, const QTransform& canvasToWidget);

/// Where the teeth of a cut stand: on the side in front, `spacing` widget pixels from each other. Each is a
/// triangle in widget coordinates.
QVector<QPolygonF> teethOf(const Cut& cut, const QTransform& canvasToWidget, double spacing);

} // namespace lampblack
