#include "scene/scene.h"

namespace lampblack
{

Material materialOf(const Scene& scene, const QString& colour)
{
    return scene.materials.value(colour, scene.defaultMaterial);
}

double defaultHeight(const Canvas& canvas)
{
    return qMax(canvas.width, canvas.height) / 2.0;
}

AreaLight defaultLight(const Canvas& canvas, double x, double y)
{
    AreaLight light;
    light.x = x;
    light.y = y;
    light.z = defaultHeight(canvas);
    light.size = qMax(1.0, 0.4 * light.z);
    light.power = 1.2; // most of a character is turned away from its light
    return light;
}

Scene defaultScene(const QSize& canvas)
{
    Scene scene;
    scene.canvas = {canvas.width(), canvas.height()};
    scene.lights = {defaultLight(scene.canvas, 0.25 * canvas.width(), 0.2 * canvas.height())};
    return scene;
}

} // namespace lampblack
