// The header frame: strict JSON in and out (SPEC 3.1).
#pragma once

#include "protocol/generated/error_code.h"
#include "protocol/generated/limits.h"
#include "protocol/messages.h"

#include <QJsonObject>

#include <optional>
#include <variant>

namespace lampblack::protocol
{

struct HeaderFault
{
    ErrorCode code = ErrorCode::BadJson;
    QString details;
};

/// The bytes that every header begins with, in the place of its opening brace.
QByteArray headerBeginning();

/// First bytes, major version, depth, JSON and numbers, in this order. The length was checked before.
std::variant<QJsonObject, HeaderFault> parseHeader(const QByteArray& header, const Limits& limits);

/// Type, direction and fields; unknown fields are ignored, those of the scene kept.
std::variant<Message, HeaderFault> readMessage(const QJsonObject& tree, Sender sender);

/// A message as it is understood: its type and every field, defaults spelled out.
QJsonObject messageTree(const Message& message);

/// The same to be sent: of the scene's materials, what equals the defaults is left out, so that more fit.
QJsonObject wireTree(const Message& message);

} // namespace lampblack::protocol
