// Every message, as SPEC 8 has them.
#pragma once

#include "protocol/generated/messages.h"

namespace lampblack::protocol
{

/// The message's name on the wire, such as "put_frame".
QString typeOf(const Message& message);

} // namespace lampblack::protocol
