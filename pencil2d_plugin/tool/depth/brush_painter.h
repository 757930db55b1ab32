// Paints the strokes of the brush, and the brush itself, over the picture of the depth.
#pragma once

#include "tool/depth/stroke_edit.h"

#include <QPainter>

namespace lampblack
{

/// What is seen while the brush is used.
struct BrushView
{
    QVector<DepthStroke> strokes; ///< of this frame
    int hovered = -1;             ///< index of one of them
    QPolygonF drawn;              ///< the stroke that is being drawn, canvas pixels
    BrushSettings brush;
    std::optional<QPointF> pointer; ///< canvas pixels
};

/// Everything in widget coordinates but the view.
void paintBrush(QPainter& painter, const BrushView& view, const QTransform& canvasToWidget);

} // namespace lampblack
