// Changes of the materials of flat colours.
#pragma once

#include "scene/scene.h"

namespace lampblack
{

/// `scene` with `material` for the flat colour "#rrggbb". A colour with the default material is not stored,
/// so that it follows later changes of the default.
Scene withMaterial(Scene scene, const QString& colour, const Material& material);

/// `scene` with another roughness for every colour that has the default roughness.
Scene withRoughness(Scene scene, double roughness);

/// How the artist has corrected the surface of the flat colour "#rrggbb".
DepthColour correctionOf(const Scene& scene, const QString& colour);

/// `scene` with a correction of the surface of one flat colour. One that corrects nothing is not stored.
Scene withCorrection(Scene scene, const DepthColour& correction);

} // namespace lampblack
