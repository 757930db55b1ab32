// What a drawing looks like in the light of a scene, at once and about: a stand-in until the lit picture
// comes.
#pragma once

#include "tool/canvas/instant_light.h"
#include "tool/canvas/instant_rim.h"

namespace lampblack
{

/// The drawing in that light: Format_RGBA8888_Premultiplied, its long side at most `longSide` pixels. Where
/// lines enclose bare paper the picture darkens what is under it. Colours whose material is neither diffuse
/// nor glossy, or shines itself, stay as drawn.
QImage shadedDrawing(const QImage& drawing, const InstantShape& shape, const InstantLight& light,
                     const InstantRim& rim, const Scene& scene, int longSide = 1024);

} // namespace lampblack
