#include "tool/depth/colour_depth.h"

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{

constexpr double VolumeNotch = 1.5;
constexpr double LeastVolume = 0.25; // less is flat
constexpr double NearerNotch = 0.02;

auto find(const QVector<DepthColour>& colours, const QColor& colour)
{
    return std::find_if(colours.begin(), colours.end(),
                        [&colour](const DepthColour& said) { return said.colour.rgb() == colour.rgb(); });
}

DepthColour moved(DepthColour said, double by)
{
    said.nearer = std::clamp(said.nearer + by, -1.0, 1.0);
    if (std::abs(said.nearer) < NearerNotch / 2) // there and back again
        said.nearer = 0;
    return said;
}

} // namespace

DepthColour depthOf(const Scene& scene, const QColor& colour)
{
    const auto* const found = find(scene.depth.colours, colour);
    if (found != scene.depth.colours.end())
        return *found;
    DepthColour said;
    said.colour = colour;
    return said;
}

Scene withDepthOf(const Scene& scene, const DepthColour& said)
{
    Scene result = scene;
    QVector<DepthColour>& colours = result.depth.colours;
    const int index = int(find(colours, said.colour) - colours.constBegin());
    const bool isThere = index < colours.size();
    const bool saysNothing = said.volume == 1 && said.nearer == 0 && said.extra.isEmpty();
    if (isThere && saysNothing)
        colours.remove(index);
    else if (isThere)
        colours[index] = said;
    else if (!saysNothing && colours.size() < MaxDepthColours)
        colours.append(said);
    return result;
}

DepthColour rounder(DepthColour said)
{
    said.volume = said.volume < LeastVolume ? LeastVolume : std::min(MaxVolume, said.volume * VolumeNotch);
    if (std::abs(said.volume - 1) < 0.05) // there and back again
        said.volume = 1;
    return said;
}

DepthColour flatter(DepthColour said)
{
    said.volume = said.volume / VolumeNotch < LeastVolume ? 0 : said.volume / VolumeNotch;
    if (std::abs(said.volume - 1) < 0.05)
        said.volume = 1;
    return said;
}

DepthColour nearer(DepthColour said)
{
    return moved(std::move(said), NearerNotch);
}

DepthColour farther(DepthColour said)
{
    return moved(std::move(said), -NearerNotch);
}

} // namespace lampblack
