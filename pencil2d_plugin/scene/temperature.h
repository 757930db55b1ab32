// Colours of light by their temperature: candles are warm, a blue sky is cold.
#pragma once

#include <QColor>

namespace lampblack
{

constexpr double WarmestKelvin = 1800;
constexpr double ColdestKelvin = 12000;

/// The colour in sRGB of a black body of `kelvin`, as bright as sRGB can show it. It follows the Planckian
/// locus in the approximation of Kim et al. (US patent 7024034, 2002), good from 1667 to 25000 K; values
/// beyond are clamped.
QColor colourOfKelvin(double kelvin);

/// The temperature, WarmestKelvin to ColdestKelvin, whose colour has the same proportion of red to
/// green and blue.
double kelvinOfColour(const QColor& colour);

} // namespace lampblack
