// Which lights of a scene shine, and how strongly in the middle of the canvas. See full_light.py.
#pragma once

#include "scene/linear_light.h"
#include "scene/scene.h"

#include <QVector3D>

namespace lampblack
{

struct LampStrength
{
    QVector3D place; ///< canvas pixels
    bool isSun;
    LinearColour weight; ///< its colour times its power
    double strength;     ///< of its light on a surface in the middle of the canvas that faces it
};

/// The lights that shine. `scene` is without keys.
QVector<LampStrength> shiningLights(const Scene& scene);

} // namespace lampblack
