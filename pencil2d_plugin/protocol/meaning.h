// What the fields of a message mean together (SPEC 3.4): each may be sound and the message still is not.
#pragma once

#include "protocol/header.h"

namespace lampblack::protocol
{

/// A camera without inverse, or a frame list that runs backwards or names too many; nothing if all is well.
std::optional<HeaderFault> meaningFault(const Message& message);

} // namespace lampblack::protocol
