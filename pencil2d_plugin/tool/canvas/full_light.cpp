#include "tool/canvas/full_light.h"

#include <algorithm>

namespace lampblack
{

namespace
{
constexpr double Behind = 0.25; ///< share of the full light of a light behind the paper
} // namespace

QVector<LampStrength> shiningLights(const Scene& scene)
{
    const QVector3D middle(float(scene.canvas.width) / 2, float(scene.canvas.height) / 2, 0);
    const bool alone = std::any_of(scene.lights.begin(), scene.lights.end(),
                                   [](const AreaLight& light) { return light.on && light.solo; });
    QVector<LampStrength> found;
    for (const AreaLight& light : scene.lights)
    {
        if (!light.on || (alone && !light.solo))
            continue;
        const QVector3D place(float(light.x), float(light.y), float(light.z));
        const double distance = std::max(1e-3F, (place - middle).length());
        const bool isSun = light.kind == LightKind::Sun;
        const double near = isSun ? 1 : std::pow(defaultHeight(scene.canvas) / distance, 2);
        const double behind = std::clamp(-light.z / distance / 0.3, 0.0, 1.0);
        const LinearColour weight = linearColour(light.colour, light.power);
        const double brightest = std::max({weight[0], weight[1], weight[2]});
        found.append({place, isSun, weight, brightest * near * (1 - (1 - Behind) * behind)});
    }
    return found;
}

} // namespace lampblack
