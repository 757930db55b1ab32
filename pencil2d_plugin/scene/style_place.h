// Styles: the look and the rim of a scene, to be used again in others.
#pragma once

#include "scene/scene.h"

#include <QVector>

namespace lampblack
{

/// Those that come with Lampblack, in the order of StyleNames.
QVector<Style> presetStyles();

/// `scene` with the look and the rim of `style`, which replace its own: as `with_style` in Python.
Scene withStyle(Scene scene, const Style& style);

/// The rim on a canvas that is `scale` times as large.
std::optional<Rim> scaledRim(std::optional<Rim> rim, double scale);

} // namespace lampblack
