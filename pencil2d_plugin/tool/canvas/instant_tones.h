// The tones of a cel look, for instant shading.
#pragma once

#include "scene/scene.h"
#include "tool/canvas/full_light.h"

#include <array>

namespace lampblack
{

/// What the drawn colour is multiplied by, from the shade to the brightest tone. See tones.py.
class InstantTones
{
public:
    /// It is empty if neither the scene's look nor that of a colour has tones.
    explicit InstantTones(const Scene& scene);

    bool isEmpty() const { return mSteps.isEmpty(); }

    /// The full light at a place of the canvas, by which `amount` is counted.
    double fullLight(double x, double y) const;

    /// For direct light of `amount` times the full light: red, green and blue in sRGB values.
    const std::array<float, 3>& at(float amount) const;

private:
    struct Step
    {
        float begin;
        float end;
    };

    static constexpr int Levels = 64;

    QVector<Step> mSteps;
    QVector<LampStrength> mLamps;
    QVector3D mMiddle;
    std::array<std::array<float, 3>, Levels + 1> mTable{};
};

} // namespace lampblack
