// What the planes of a message must satisfy, together with its header (SPEC 3.2, 3.4).
#pragma once

#include "protocol/codec.h"
#include "protocol/header.h"

namespace lampblack::protocol
{

/// What the header says of the frames that follow it; none for messages that carry none.
QVector<Plane> planesOf(const Message& message);

/// Number, roles, formats, extent, strides, sameness of size, payloads and digest, in this order; nothing
/// if all is well. `payloads` are the frames after the header.
std::optional<HeaderFault> planeFault(const Message& message, const QVector<Bytes>& payloads,
                                      const Limits& limits);

} // namespace lampblack::protocol
