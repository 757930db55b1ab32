// Light from colours and back, near enough for stand-ins and icons: the worker has sRGB's own curve.
#pragma once

#include <QColor>

#include <array>
#include <cmath>

namespace lampblack
{

using LinearColour = std::array<double, 3>; ///< red, green, blue; 1 is white

inline double toLinear(double encoded)
{
    return std::pow(encoded, 2.2);
}

/// 0 for what is negative.
inline double fromLinear(double light)
{
    return std::pow(light > 0 ? light : 0, 1 / 2.2);
}

inline LinearColour linearColour(const QColor& colour, double strength = 1)
{
    return {strength * toLinear(colour.redF()), strength * toLinear(colour.greenF()),
            strength * toLinear(colour.blueF())};
}

} // namespace lampblack
