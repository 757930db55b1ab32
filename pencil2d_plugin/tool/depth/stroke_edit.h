// Strokes of a brush that correct the surface, as edits of the scene.
#pragma once

#include "scene/scene.h"

#include <QPolygonF>
#include <QTransform>

#include <optional>

namespace lampblack
{

constexpr int MaxStrokes = 128; ///< of the schema, as the next
constexpr int MaxStrokePoints = 24;

/// A brush as the artist has set it.
struct BrushSettings
{
    Brush brush = Brush::Bump;
    double radius = 40; ///< canvas pixels
    double amount = 0.4;
};

/// Whether another stroke fits into the scene.
bool hasRoomForStroke(const Scene& scene);

/// With a stroke along `line`, canvas pixels, at `frame`. Without room the scene as it was.
Scene withStroke(const Scene& scene, int frame, const QPolygonF& line, const BrushSettings& brush);
/// Without one stroke, an index into its strokes; unchanged if there is none.
Scene withoutStroke(const Scene& scene, int stroke);
/// Without all strokes of `frame`, or of all frames.
Scene withoutStrokes(const Scene& scene, std::optional<int> frame = {});

/// Canvas pixels.
QPolygonF lineOf(const DepthStroke& stroke);

/// Index of the stroke of `frame` whose line is under `position` (widget coordinates), or -1. `reach` is in
/// widget pixels.
int strokeUnder(const Scene& scene, int frame, const QTransform& canvasToWidget, const QPointF& position,
                double reach);

} // namespace lampblack
