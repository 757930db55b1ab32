// Changes of what flat colours wear.
#pragma once

#include "scene/scene.h"

namespace lampblack
{

/// `scene` with the flat colour "#rrggbb" wearing `material`. A colour that wears the default is not
/// listed, so that it follows the default.
Scene withMaterial(Scene scene, const QString& colour, const Material& material);

/// `scene` with another roughness for every colour that was not given one of its own.
Scene withRoughness(Scene scene, double roughness);

} // namespace lampblack
