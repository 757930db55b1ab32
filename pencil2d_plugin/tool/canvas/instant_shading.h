// What a drawing looks like in the light of a scene, at once and about: a stand-in until the lit picture
// comes.
#pragma once

#include "scene/scene.h"
#include "tool/canvas/instant_shape.h"

#include <QTransform>

namespace lampblack
{

/// The light on a shape: what the drawn colour is multiplied by, for each element of its grid and around it.
struct InstantLight
{
    QVector<float> red; ///< 1 is as drawn, in sRGB values
    QVector<float> green;
    QVector<float> blue;
    QVector<float> amount; ///< direct light as a share of the full light; only where the look has tones
};

/// The scene's light on a drawing's shape. `scene` is without keys, `canvasToImage` the camera of the
/// drawing. Area lights and suns shine on a surface as in the renderer, but nothing throws a shadow and
/// nothing shines back.
InstantLight lightOn(const InstantShape& shape, const Scene& scene, const QTransform& canvasToImage);

/// The drawing in that light: Format_RGBA8888_Premultiplied, its long side at most `longSide` pixels. Where
/// lines enclose bare paper the picture darkens what is under it. Colours whose material is neither diffuse
/// nor glossy, or shines itself, stay as drawn.
QImage shadedDrawing(const QImage& drawing, const InstantShape& shape, const InstantLight& light,
                     const Scene& scene, int longSide = 1024);

} // namespace lampblack
