#include "scene/scene_file.h"

#include "scene/json_text.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QJsonDocument>
#include <QSaveFile>

namespace lampblack
{
namespace
{

constexpr qint64 MaxDepth = 31; // one less than a header, which has to carry the scene

QString tr(const char* text)
{
    return QCoreApplication::translate("SceneFile", text);
}

UserError unusable(const QString& path, const QString& why)
{
    return {tr("The light saved in %1 cannot be used.").arg(QFileInfo(path).fileName()),
            tr("Correct that file, or make new lights."), path + QLatin1String(": ") + why};
}

UserError unwritable(const QString& path, const QString& why)
{
    return {
        tr("The light could not be saved in %1.").arg(QFileInfo(path).fileName()),
        tr("Check that there is space on the disk, and that you may write to the folder. Then save again."),
        path + QLatin1String(": ") + why};
}

} // namespace

std::variant<Scene, UserError> readSceneFile(const QString& path)
{
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly))
    {
        return unusable(path, file.errorString());
    }
    const QByteArray text = file.read(MaxJsonBytes + 1);
    if (text.size() > MaxJsonBytes)
    {
        return unusable(path, tr("longer than %1 bytes").arg(MaxJsonBytes));
    }
    if (nestingDepth(text) > MaxDepth)
    {
        return unusable(path, tr("nested more than %1 deep").arg(MaxDepth));
    }
    const auto parsed = parseJson(text);
    if (const auto* fault = std::get_if<JsonFault>(&parsed))
    {
        return unusable(path, fault->details);
    }
    QString why;
    const std::optional<Scene> scene = sceneFromJson(std::get<QJsonObject>(parsed), &why);
    if (!scene)
    {
        return unusable(path, why);
    }
    return *scene;
}

std::optional<UserError> writeSceneFile(const QString& path, const Scene& scene)
{
    const QByteArray text = QJsonDocument(toJson(scene)).toJson(QJsonDocument::Indented);
    if (text.size() > MaxJsonBytes)
    {
        return unwritable(path, tr("the scene would be longer than %1 bytes").arg(MaxJsonBytes));
    }
    if (QFileInfo::exists(path) && std::holds_alternative<UserError>(readSceneFile(path)) &&
        setAside(path).isEmpty())
    {
        return unwritable(path, tr("the damaged file there cannot be renamed"));
    }
    QSaveFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size() || !file.commit())
    {
        return unwritable(path, file.errorString());
    }
    return std::nullopt;
}

QString setAside(const QString& path)
{
    constexpr int Most = 99;
    for (int count = 1; count <= Most; ++count)
    {
        const QString aside =
            path + QLatin1String(".broken") + (count > 1 ? QString::number(count) : QString());
        if (!QFileInfo::exists(aside))
        {
            return QFile::rename(path, aside) ? aside : QString();
        }
    }
    return {};
}

} // namespace lampblack
