// The connection file: how a client finds its worker (SPEC 2).
#pragma once

#include "protocol/generated/messages.h"

namespace lampblack::protocol
{

/// Read a connection file; on failure returns nothing and says why in `fault`, if given.
std::optional<Connection> readConnection(const QString& path, QString* fault = nullptr);

} // namespace lampblack::protocol
