// Why a message is refused (protocol/ERRORS.md): the codes that decoding can give.
#pragma once

#include <QString>

namespace lampblack::protocol
{

enum class ErrorCode
{
    BadFrameCount,
    HeaderTooLarge,
    PlaneTooLarge,
    NotLampblack,
    VersionMismatch,
    BadJson,
    TooDeep,
    BadNumber,
    UnknownType,
    WrongDirection,
    BadField,
    BadValue,
    BadScene,
    BadPlaneCount,
    BadPlane,
    ImageTooLarge,
    PlaneSizeMismatch,
    DigestMismatch
};

/// The code's name on the wire, such as "bad_field".
QString name(ErrorCode code);

} // namespace lampblack::protocol
