// How the handles of lights and floor look.
#pragma once

#include "tool/canvas/handles.h"

#include <QPainter>

namespace lampblack
{

/// Paints in widget coordinates. Every stroke is light on dark, so that it shows on any drawing.
void paintHandles(QPainter& painter, const Handles& handles, const Handle& hovered);

/// A word beside the pointer while something is dragged, kept inside `view`.
void paintTag(QPainter& painter, const QString& text, const QPointF& beside, const QSize& view);

/// The place that paintTag() takes.
QRect tagBounds(const QFont& font, const QString& text, const QPointF& beside, const QSize& view);

} // namespace lampblack
