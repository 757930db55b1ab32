#include "protocol/codec.h"

#include "protocol/header.h"
#include "protocol/meaning.h"
#include "protocol/plane_checks.h"
#include "scene/json_text.h"

#include <QJsonDocument>

#include <algorithm>
#include <cmath>

namespace lampblack::protocol
{
namespace
{

std::optional<HeaderFault> sizeFault(const QVector<Bytes>& frames, const Limits& limits)
{
    if (frames.isEmpty() || frames.size() > 1 + limits.planes)
    {
        return HeaderFault{ErrorCode::BadFrameCount, QStringLiteral("%1 frames").arg(frames.size())};
    }
    if (frames.first().size > limits.headerBytes)
    {
        return HeaderFault{ErrorCode::HeaderTooLarge, QStringLiteral("%1 bytes").arg(frames.first().size)};
    }
    const auto* large =
        std::find_if(frames.begin() + 1, frames.end(),
                     [&limits](const Bytes& payload) { return payload.size > limits.planeBytes; });
    if (large != frames.end())
    {
        return HeaderFault{ErrorCode::PlaneTooLarge, QStringLiteral("%1 bytes").arg(large->size)};
    }
    return std::nullopt;
}

Refusal refusal(const HeaderFault& fault, const QJsonObject& tree = {})
{
    Refusal refused = {fault.code, fault.details, tree.value(QLatin1String("type")).toString().left(40), {}};
    const double request = tree.value(QLatin1String("request")).toDouble();
    if (request >= 1 && request <= MaxNumber && request == std::floor(request))
    {
        refused.request = static_cast<quint64>(request);
    }
    return refused;
}

Decoded decodeTree(const QJsonObject& tree, const QVector<Bytes>& payloads, Sender sender,
                   const Limits& limits)
{
    const auto read = readMessage(tree, sender);
    if (const auto* fault = std::get_if<HeaderFault>(&read))
    {
        return refusal(*fault, tree);
    }
    Received received = {std::get<Message>(read), {}};
    std::optional<HeaderFault> fault = meaningFault(received.message);
    fault = fault ? fault : planeFault(received.message, payloads, limits);
    if (fault)
    {
        return refusal(*fault, tree);
    }
    const QVector<Plane> planes = planesOf(received.message);
    for (int i = 0; i < planes.size(); ++i)
    {
        received.planes.append({planes[i], static_cast<const uchar*>(payloads[i].data)});
    }
    return received;
}

} // namespace

Decoded decode(const QVector<Bytes>& frames, Sender sender, const Limits& limits)
{
    if (const std::optional<HeaderFault> fault = sizeFault(frames, limits))
    {
        return refusal(*fault);
    }
    const Bytes& first = frames.first();
    const QByteArray header =
        QByteArray::fromRawData(static_cast<const char*>(first.data), static_cast<int>(first.size));
    const auto parsed = parseHeader(header, limits);
    if (const auto* fault = std::get_if<HeaderFault>(&parsed))
    {
        return refusal(*fault);
    }
    return decodeTree(std::get<QJsonObject>(parsed), frames.mid(1), sender, limits);
}

std::optional<QByteArray> encode(const Message& message)
{
    QByteArray header = QJsonDocument(wireTree(message)).toJson(QJsonDocument::Compact);
    header.replace(0, 1, headerBeginning());
    return header.size() <= Limits().headerBytes ? std::optional<QByteArray>(header) : std::nullopt;
}

} // namespace lampblack::protocol
