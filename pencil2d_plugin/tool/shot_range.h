// Which frames "Render All Frames" renders.
#pragma once

namespace lampblack
{

enum class ShotRange
{
    All,
    Loop, ///< the loop range of the timeline
    Current
};

} // namespace lampblack
