// Which frames "Render All Frames" renders.
#pragma once

namespace lampblack
{

enum class ShotRange
{
    All,
    Loop, ///< from the start to the end of the loop that is played
    Current
};

} // namespace lampblack
