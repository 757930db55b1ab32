// Keys for a worker on another machine: CURVE, the encryption of ZeroMQ.
#pragma once

#include <QString>

#include <optional>
#include <string>

namespace lampblack
{

/// Keys of 40 characters (Z85) each.
struct CurveKeys
{
    std::string worker; ///< public key of the worker; empty: without encryption
    std::string ownPublic;
    std::string ownSecret;
};

/// From the files that `lampblack key` makes: the worker's .key, and our .key_secret. No value if one of them
/// cannot be read, or holds no such key; `unread` then names it.
std::optional<CurveKeys> readCurveKeys(const QString& workerKey, const QString& ownKey, QString* unread);

} // namespace lampblack
