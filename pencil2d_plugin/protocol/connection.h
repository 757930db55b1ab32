// The connection file: how a client finds its worker (SPEC 2).
#pragma once

#include <QString>

#include <optional>

namespace lampblack::protocol
{

struct Connection
{
    int majorVersion = 1; ///< another than Major: tell the user to update, and do not connect
    int minorVersion = 0;
    QString endpoint; ///< for zmq_connect, "ipc:///..."
    qint64 pid = 0;
};

/// Read a connection file; on failure returns nothing and says why in `fault`, if given.
std::optional<Connection> readConnection(const QString& path, QString* fault = nullptr);

} // namespace lampblack::protocol
