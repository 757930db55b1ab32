// Frames of a ZeroMQ message to a message and its planes, and back (SPEC 3).
#pragma once

#include "protocol/generated/error_code.h"
#include "protocol/generated/limits.h"
#include "protocol/messages.h"
#include "protocol/planes.h"

#include <optional>
#include <variant>

namespace lampblack::protocol
{

/// One frame as it came; it owns nothing.
struct Bytes
{
    const void* data = nullptr;
    qint64 size = 0;
};

/// A message that passed every check. `planes` point into the frames: keep these until toImage().
struct Received
{
    Message message;
    QVector<PlaneView> planes;
};

/// Why a message must not be acted upon, for the log; about and request as far as they could be read.
struct Refusal
{
    ErrorCode code = ErrorCode::BadJson;
    QString details;
    QString about;
    std::optional<quint64> request;
};

using Decoded = std::variant<Received, Refusal>;

/// Read one multipart message, without any routing identity, sent by `sender`. Never throws.
Decoded decode(const QVector<Bytes>& frames, Sender sender, const Limits& limits = {});

/// The header frame; nothing if it would be longer than SPEC allows. The message's `planes` must describe
/// the frames that are sent after it, as viewOf() does.
std::optional<QByteArray> encode(const Message& message);

} // namespace lampblack::protocol
