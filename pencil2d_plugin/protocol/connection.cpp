#include "protocol/connection.h"

#include "protocol/generated/message_fields.h"

#include <QFile>

namespace lampblack::protocol
{
namespace
{

constexpr qint64 MaxBytes = 4096;
constexpr qint64 MaxDepth = 32;

} // namespace

std::optional<Connection> readConnection(const QString& path, QString* fault)
{
    QString ignored;
    QString& why = fault != nullptr ? *fault : ignored;
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
    {
        why = file.errorString();
        return std::nullopt;
    }
    const QByteArray text = file.read(MaxBytes + 1);
    if (text.size() > MaxBytes || nestingDepth(text) > MaxDepth)
    {
        why = QStringLiteral("no connection file");
        return std::nullopt;
    }
    const auto parsed = parseJson(text);
    if (const auto* broken = std::get_if<JsonFault>(&parsed))
    {
        why = broken->details;
        return std::nullopt;
    }
    JsonReader reader(std::get<QJsonObject>(parsed));
    Connection connection;
    describe(reader, connection);
    why = reader.fault();
    return why.isEmpty() ? std::optional<Connection>(connection) : std::nullopt;
}

} // namespace lampblack::protocol
