// Paints the handles of lights and floor.
#pragma once

#include "tool/canvas/handles.h"

#include <QPainter>

namespace lampblack
{

/// Paints in widget coordinates. Every stroke is light with a dark outline, so that it is visible on any
/// drawing.
void paintHandles(QPainter& painter, const Handles& handles, const Handle& hovered);

/// Paint a short text beside the pointer, inside `view`.
void paintTag(QPainter& painter, const QString& text, const QPointF& position, const QSize& view);

/// The rectangle that paintTag() paints.
QRect tagBounds(const QFont& font, const QString& text, const QPointF& position, const QSize& view);

} // namespace lampblack
