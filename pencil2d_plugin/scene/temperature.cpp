#include "scene/temperature.h"

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{

constexpr double LeastKelvin = 1667;
constexpr double MostKelvin = 25000;

double cubic(double a, double b, double c, double d, double at)
{
    return ((a * at + b) * at + c) * at + d;
}

double linear(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encoded(double linear)
{
    const double value = std::clamp(linear, 0.0, 1.0);
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

} // namespace

QColor colourOfKelvin(double kelvin)
{
    const double t = std::clamp(kelvin, LeastKelvin, MostKelvin);
    const double x = t < 4000 ? cubic(-0.2661239e9, -0.2343589e6, 0.8776956e3, 0.179910, 1 / t)
                              : cubic(-3.0258469e9, 2.1070379e6, 0.2226347e3, 0.240390, 1 / t);
    const double y = t < 2222   ? cubic(-1.1063814, -1.34811020, 2.18555832, -0.20219683, x)
                     : t < 4000 ? cubic(-0.9549476, -1.37418593, 2.09137015, -0.16748867, x)
                                : cubic(3.0817580, -5.87338670, 3.75112997, -0.37001483, x);
    const double X = x / y;
    const double Z = (1 - x - y) / y;
    const double red = 3.2404542 * X - 1.5371385 - 0.4985314 * Z;
    const double green = -0.9692660 * X + 1.8760108 + 0.0415560 * Z;
    const double blue = 0.0556434 * X - 0.2040259 + 1.0572252 * Z;
    const double most = std::max({red, green, blue});
    return QColor::fromRgbF(encoded(red / most), encoded(green / most), encoded(blue / most)).toRgb();
}

double kelvinOfColour(const QColor& colour)
{
    // Green as well, because the warmest have no blue at all.
    const auto blueness = [](const QColor& of)
    {
        return (linear(of.blueF()) + linear(of.greenF())) / std::max(1e-6, linear(of.redF()));
    };
    const double wanted = blueness(colour);
    double warm = WarmestKelvin;
    double cold = ColdestKelvin;
    constexpr int Halvings = 24;
    for (int step = 0; step < Halvings; ++step)
    {
        const double middle = (warm + cold) / 2;
        (blueness(colourOfKelvin(middle)) < wanted ? warm : cold) = middle;
    }
    return (warm + cold) / 2;
}

} // namespace lampblack
