#include "protocol/header.h"

#include "scene/json_text.h"

namespace lampblack::protocol
{
namespace
{

const QByteArray& magic()
{
    static const QByteArray bytes("{\"lampblack\":");
    return bytes;
}

} // namespace

QByteArray headerBeginning()
{
    return magic() + QByteArray::number(Major) + ',';
}

std::variant<QJsonObject, HeaderFault> parseHeader(const QByteArray& header, const Limits& limits)
{
    if (!header.startsWith(magic()))
    {
        return HeaderFault{ErrorCode::NotLampblack, QString::fromLatin1(header.left(magic().size()).toHex())};
    }
    if (!header.startsWith(headerBeginning()))
    {
        return HeaderFault{ErrorCode::VersionMismatch,
                           QString::fromLatin1(header.mid(magic().size(), 4).toHex())};
    }
    const qint64 depth = nestingDepth(header);
    if (depth > limits.depth)
    {
        return HeaderFault{ErrorCode::TooDeep, QStringLiteral("%1 deep").arg(depth)};
    }
    const auto parsed = parseJson(header);
    if (const auto* fault = std::get_if<JsonFault>(&parsed))
    {
        const bool number = fault->kind == JsonFault::Kind::Number;
        return HeaderFault{number ? ErrorCode::BadNumber : ErrorCode::BadJson, fault->details};
    }
    return std::get<QJsonObject>(parsed);
}

} // namespace lampblack::protocol
