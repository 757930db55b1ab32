// The light of a scene on the guess at a drawing's surface.
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

} // namespace lampblack
