#include "scene/scene.h"

#include <tuple>

namespace lampblack
{
namespace
{

auto members(const LightKey& key)
{
    return std::tie(key.frame, key.x, key.y, key.z, key.size, key.colour, key.power, key.extra);
}

auto members(const AreaLight& light)
{
    return std::tie(light.x, light.y, light.z, light.size, light.colour, light.power, light.keys,
                    light.extra);
}

auto members(const Ambient& ambient)
{
    return std::tie(ambient.colour, ambient.strength, ambient.extra);
}

auto members(const Material& material)
{
    return std::tie(material.diffuse, material.glossy, material.gloss, material.roughness, material.extra);
}

auto members(const FloorKey& key)
{
    return std::tie(key.frame, key.y, key.pitch, key.extra);
}

auto members(const Floor& floor)
{
    return std::tie(floor.y, floor.pitch, floor.keys, floor.extra);
}

auto members(const Scene& scene)
{
    return std::tie(scene.canvas, scene.canvasExtra, scene.lights, scene.ambient, scene.materials,
                    scene.defaultMaterial, scene.floor, scene.reliefScale, scene.quality, scene.extra);
}

} // namespace

bool operator==(const LightKey& a, const LightKey& b)
{
    return members(a) == members(b);
}

bool operator==(const AreaLight& a, const AreaLight& b)
{
    return members(a) == members(b);
}

bool operator==(const Ambient& a, const Ambient& b)
{
    return members(a) == members(b);
}

bool operator==(const Material& a, const Material& b)
{
    return members(a) == members(b);
}

bool operator==(const FloorKey& a, const FloorKey& b)
{
    return members(a) == members(b);
}

bool operator==(const Floor& a, const Floor& b)
{
    return members(a) == members(b);
}

bool operator==(const Scene& a, const Scene& b)
{
    return members(a) == members(b);
}

AreaLight defaultLight(const QSize& canvas, double x, double y)
{
    const double height = qMax(canvas.width(), canvas.height()) / 2.0;
    AreaLight light;
    light.x = x;
    light.y = y;
    light.z = height;
    light.size = qMax(1.0, 0.4 * height);
    light.power = 1.2; // most of a figure is turned away from its light
    return light;
}

Scene defaultScene(const QSize& canvas)
{
    Scene scene;
    scene.canvas = canvas;
    scene.lights = {defaultLight(canvas, 0.25 * canvas.width(), 0.2 * canvas.height())};
    return scene;
}

} // namespace lampblack
