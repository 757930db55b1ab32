// The surface of a flat colour, rounder or flatter, nearer or farther, as edits of the scene.
#pragma once

#include "scene/scene.h"

#include <QColor>

namespace lampblack
{

constexpr int MaxDepthColours = 256; ///< of the schema
constexpr double MaxVolume = 4;

/// What the artist says of the surface of `colour`; the defaults if nothing is said.
DepthColour depthOf(const Scene& scene, const QColor& colour);
/// With that said of its colour. What says nothing is left out. Without room the scene as it was.
Scene withDepthOf(const Scene& scene, const DepthColour& said);

// One notch further. At the end of the range they change nothing.
DepthColour rounder(DepthColour said);
DepthColour flatter(DepthColour said);
DepthColour nearer(DepthColour said);
DepthColour farther(DepthColour said);

} // namespace lampblack
