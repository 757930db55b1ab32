#include "vectors.h"

#include "protocol/header.h"

#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>

namespace lampblack::protocol
{
namespace
{

QByteArray contents(const QString& path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

bool write(const QString& path, const QByteArray& bytes)
{
    QFile file(path);
    return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size();
}

QString frameFile(int index)
{
    return index == 0 ? QStringLiteral("header.json") : QStringLiteral("plane%1.bin").arg(index - 1);
}

void take(const QJsonObject& limits, const char* name, qint64& limit)
{
    limit = static_cast<qint64>(limits.value(QLatin1String(name)).toDouble(static_cast<double>(limit)));
}

} // namespace

Case readCase(const QString& folder)
{
    Case message;
    const QDir dir(folder);
    message.name = dir.dirName();
    message.expected =
        QJsonDocument::fromJson(contents(dir.filePath(QStringLiteral("expected.json")))).object();
    const QString sender = message.expected.value(QLatin1String("sender")).toString();
    message.sender = sender == QLatin1String("client") ? Sender::Client : Sender::Worker;
    const QJsonObject limits = message.expected.value(QLatin1String("limits")).toObject();
    take(limits, "header_bytes", message.limits.headerBytes);
    take(limits, "planes", message.limits.planes);
    take(limits, "plane_bytes", message.limits.planeBytes);
    take(limits, "depth", message.limits.depth);
    take(limits, "side", message.limits.side);
    take(limits, "pixels", message.limits.pixels);
    take(limits, "frame_pixels", message.limits.framePixels);
    for (int i = 0; QFile::exists(dir.filePath(frameFile(i))); ++i)
    {
        message.frames.append(contents(dir.filePath(frameFile(i))));
    }
    return message;
}

QVector<Case> readCases(const QString& folder)
{
    QVector<Case> cases;
    const QDir dir(folder);
    const QStringList names = dir.entryList(QDir::Dirs | QDir::NoDotAndDotDot, QDir::Name);
    for (const QString& name : names)
    {
        cases.append(readCase(dir.filePath(name)));
    }
    return cases;
}

bool writeCase(const QString& folder, const Case& message)
{
    const QDir dir(folder);
    const QJsonObject expected = {{QStringLiteral("sender"), message.sender == Sender::Client
                                                                 ? QStringLiteral("client")
                                                                 : QStringLiteral("worker")}};
    bool whole = dir.mkpath(QStringLiteral(".")) &&
                 write(dir.filePath(QStringLiteral("expected.json")), QJsonDocument(expected).toJson());
    for (int i = 0; i < message.frames.size(); ++i)
    {
        whole = whole && write(dir.filePath(frameFile(i)), message.frames[i]);
    }
    return whole;
}

QVector<Bytes> bytesOf(const QVector<QByteArray>& frames)
{
    QVector<Bytes> bytes;
    for (const QByteArray& frame : frames)
    {
        bytes.append({frame.constData(), frame.size()});
    }
    return bytes;
}

Decoded decodeCase(const Case& message)
{
    return decode(bytesOf(message.frames), message.sender, message.limits);
}

QJsonObject verdict(const Decoded& decoded)
{
    if (const auto* refusal = std::get_if<Refusal>(&decoded))
    {
        return {{QStringLiteral("code"), name(refusal->code)}};
    }
    static const std::array<QString, 5> Roles = {QStringLiteral("pixels"), QStringLiteral("mask"),
                                                 QStringLiteral("ink"), QStringLiteral("picture"),
                                                 QStringLiteral("layer")};
    const auto& received = std::get<Received>(decoded);
    QJsonObject planes;
    int layer = 0;
    for (const PlaneView& view : received.planes)
    {
        QString role = Roles.at(static_cast<std::size_t>(view.plane.role));
        role += view.plane.role == Role::Layer ? QString::number(layer++) : QString();
        planes.insert(role, QString::fromLatin1(rowsDigest(view)));
    }
    return {{QStringLiteral("message"), messageTree(received.message)}, {QStringLiteral("planes"), planes}};
}

} // namespace lampblack::protocol
