#include "tool/canvas/instant_tones.h"

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{

double largest(const LinearColour& colour)
{
    return std::max({colour[0], colour[1], colour[2]});
}

/// The scene's look; of one without tones, in which some colour is in tones, what that colour has.
Look lookOfTones(const Scene& scene)
{
    Look look = scene.look;
    const bool hasCel =
        std::any_of(scene.materials.begin(), scene.materials.end(),
                    [](const Material& material) { return material.look == LookChoice::Cel; });
    if (look.tones.isEmpty() && (hasCel || scene.defaultMaterial.look == LookChoice::Cel))
    {
        look = Look();
        look.tones = {0.42};
        look.shadeStrength = 0.5;
        look.shadeColour = scene.look.shadeColour;
    }
    return look;
}

} // namespace

InstantTones::InstantTones(const Scene& scene)
    : mLamps(shiningLights(scene)), mMiddle(float(scene.canvas.width) / 2, float(scene.canvas.height) / 2, 0)
{
    const Look look = lookOfTones(scene);
    QVector<double> tones = look.tones;
    std::sort(tones.begin(), tones.end());
    for (const double tone : qAsConst(tones))
    {
        const double begin = std::max(0.0, tone - look.softness / 2);
        const double end = tone + look.softness / 2;
        mSteps.append({float(begin * begin), float(std::max(end * end, begin * begin + 1e-3))});
    }
    LinearColour hue{};
    double full = 0;
    for (const LampStrength& lamp : qAsConst(mLamps))
    {
        full = std::max(full, lamp.strength);
        for (size_t i = 0; i < hue.size(); ++i)
            hue[i] += lamp.weight[i];
    }
    const double brightest = largest(hue);
    const LinearColour ambient = linearColour(scene.ambient.colour, scene.ambient.strength);
    const double sum = largest(ambient) + full;
    const double exposure = sum <= 1 ? 1 : (1 + 0.35 * std::log(sum)) / sum;
    const LinearColour tint = linearColour(look.shadeColour);
    for (int level = 0; level <= Levels; ++level)
    {
        for (size_t i = 0; i < hue.size(); ++i)
        {
            const double shade = ambient[i] + look.shadeStrength * (tint[i] * sum - ambient[i]);
            const double lit = ambient[i] + (brightest > 0 ? full * hue[i] / brightest : 0);
            const double light = exposure * (shade + (lit - shade) * level / Levels);
            mTable[size_t(level)][i] = float(fromLinear(light));
        }
    }
}

double InstantTones::fullLight(double x, double y) const
{
    double full = 1e-6;
    for (const LampStrength& lamp : mLamps)
    {
        const double far = (lamp.place - mMiddle).lengthSquared();
        const double near = (lamp.place - QVector3D(float(x), float(y), 0)).lengthSquared();
        const double fall = lamp.isSun ? 1 : std::sqrt(far / std::max(near, 0.02 * far + 1));
        full = std::max(full, lamp.strength * fall);
    }
    return full;
}

const std::array<float, 3>& InstantTones::at(float amount) const
{
    float total = 0;
    for (const Step& step : mSteps)
    {
        const float share = std::clamp((amount - step.begin) / (step.end - step.begin), 0.0F, 1.0F);
        total += share * share * (3 - 2 * share);
    }
    const int level = int(total / float(std::max(1, mSteps.size())) * Levels + 0.5F);
    return mTable[size_t(std::clamp(level, 0, int(Levels)))];
}

} // namespace lampblack
