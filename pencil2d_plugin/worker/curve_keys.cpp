#include "worker/curve_keys.h"

#include <QFile>
#include <QRegularExpression>

namespace lampblack
{

namespace
{

constexpr qint64 MaxBytes = 10000;

/// The value of `name` in the format of CZMQ's certificates (ZPL); empty if it has none.
std::string keyIn(const QByteArray& text, const QString& name)
{
    const QRegularExpression line(
        QStringLiteral("^\\s*%1\\s*=\\s*\"([0-9A-Za-z.:+=^!/*?&<>()\\[\\]{}@%$#-]{40})\"\\s*$").arg(name),
        QRegularExpression::MultilineOption);
    return line.match(QString::fromUtf8(text)).captured(1).toStdString();
}

QByteArray read(const QString& path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) && file.size() <= MaxBytes ? file.read(MaxBytes) : QByteArray();
}

} // namespace

std::optional<CurveKeys> readCurveKeys(const QString& workerKey, const QString& ownKey, QString* unread)
{
    const QString publicName = QStringLiteral("public-key");
    const QByteArray own = read(ownKey);
    CurveKeys keys{keyIn(read(workerKey), publicName), keyIn(own, publicName),
                   keyIn(own, QStringLiteral("secret-key"))};
    if (keys.worker.empty())
        *unread = workerKey;
    else if (keys.ownPublic.empty() || keys.ownSecret.empty())
        *unread = ownKey;
    else
        return keys;
    return std::nullopt;
}

} // namespace lampblack
