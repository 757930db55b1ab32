#include "scene/rig_file.h"

#include "scene/json_text.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QJsonDocument>
#include <QSaveFile>

namespace lampblack
{

namespace
{

constexpr qint64 MaxDepth = 31;

QString tr(const char* text)
{
    return QCoreApplication::translate("RigFile", text);
}

UserError unusable(const QString& source, const QString& why)
{
    return {tr("There are no lights in %1 that can be used.").arg(QFileInfo(source).fileName()),
            tr("Choose a file that was written by Save Lights."), source + QLatin1String(": ") + why};
}

} // namespace

QByteArray textOf(const Rig& rig)
{
    return QJsonDocument(toJson(rig)).toJson(QJsonDocument::Indented);
}

std::variant<Rig, UserError> rigFromText(const QByteArray& text, const QString& source)
{
    if (text.size() > MaxJsonBytes)
        return unusable(source, tr("longer than %1 bytes").arg(MaxJsonBytes));
    if (nestingDepth(text) > MaxDepth)
        return unusable(source, tr("nested more than %1 deep").arg(MaxDepth));
    const auto parsed = parseJson(text);
    if (const auto* fault = std::get_if<JsonFault>(&parsed))
        return unusable(source, fault->details);
    QString why;
    const std::optional<Rig> rig = rigFromJson(std::get<QJsonObject>(parsed), &why);
    if (!rig)
        return unusable(source, why);
    return *rig;
}

std::variant<Rig, UserError> readRigFile(const QString& path)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
        return unusable(path, file.errorString());
    return rigFromText(file.read(MaxJsonBytes + 1), path);
}

std::optional<UserError> writeRigFile(const QString& path, const Rig& rig)
{
    const QByteArray text = textOf(rig);
    QSaveFile file(path);
    if (file.open(QIODevice::WriteOnly) && file.write(text) == text.size() && file.commit())
        return std::nullopt;
    return UserError{tr("The lights could not be saved in %1.").arg(QFileInfo(path).fileName()),
                     tr("Choose a folder that you may write to."),
                     path + QLatin1String(": ") + file.errorString()};
}

} // namespace lampblack
