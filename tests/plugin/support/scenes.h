// Scenes to test with.
#pragma once

#include "scene/scene.h"

namespace lampblack
{

/// One light, on the canvas of FakeHost.
inline Scene sceneWithLight(double x, double y, double z)
{
    Scene scene = defaultScene(QSize(400, 300));
    scene.lights[0].x = x;
    scene.lights[0].y = y;
    scene.lights[0].z = z;
    scene.lights[0].size = 100;
    return scene;
}

} // namespace lampblack
