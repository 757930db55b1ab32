#include "worker/interpreter.h"

#include "worker/installer.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>

#include <dlfcn.h>
#include <link.h>

namespace lampblack
{

namespace
{
constexpr qint64 MaxBytes = 4096;
} // namespace

QString pluginFolder()
{
    static const char anchor = 0;
    Dl_info found{};
    void* extra = nullptr;
    const bool isFound = dladdr1(&anchor, &found, &extra, RTLD_DL_LINKMAP) != 0 && extra != nullptr;
    // A program is named as it was called: that may be a name in another folder, one that nobody trusts.
    if (!isFound || *static_cast<const link_map*>(extra)->l_name == '\0')
    {
        return QCoreApplication::applicationDirPath();
    }
    return QFileInfo(QFile::decodeName(found.dli_fname)).absolutePath();
}

Interpreter findInterpreter(const QString& folder)
{
    const QString named = qEnvironmentVariable("LAMPBLACK_PYTHON");
    if (!named.isEmpty())
    {
        return {QFileInfo(named).absoluteFilePath(), QStringLiteral("LAMPBLACK_PYTHON")};
    }
    QFile note(QDir(folder).filePath(QStringLiteral("lampblack.json")));
    if (note.open(QIODevice::ReadOnly))
    {
        const QJsonObject said = QJsonDocument::fromJson(note.read(MaxBytes)).object();
        const QString installer = said.value(QLatin1String("installer")).toString();
        const QString path = installer.isEmpty()
                                 ? said.value(QLatin1String("python")).toString()
                                 : QDir(dataFolder()).filePath(QStringLiteral("worker/bin/python"));
        return {QDir::isAbsolutePath(path) ? path : QString(), note.fileName(), installer};
    }
    const QString path = QDir(folder).filePath(QStringLiteral("../../../.venv/bin/python"));
    return {QDir::cleanPath(path), QStringLiteral("the source tree")};
}

bool isToInstall(const Interpreter& interpreter)
{
    return !interpreter.installer.isEmpty() &&
           (installedVersion(interpreter) != QLatin1String(LAMPBLACK_VERSION) ||
            !QFileInfo(interpreter.path).isExecutable());
}

QString installedVersion(const Interpreter& interpreter)
{
    QFile marker(QFileInfo(interpreter.path).absoluteDir().filePath(QStringLiteral("../complete.json")));
    if (!marker.open(QIODevice::ReadOnly))
        return {};
    return QJsonDocument::fromJson(marker.read(MaxBytes)).object().value(QLatin1String("version")).toString();
}

UserError notInstalled(const Interpreter& interpreter, const QString& details)
{
    if (!interpreter.installer.isEmpty())
    {
        return {QCoreApplication::translate("lampblack", "The lamp's renderer is not installed."),
                QCoreApplication::translate("lampblack", "Press Install in the lamp's panel."), details};
    }
    return {QCoreApplication::translate("lampblack", "The renderer of Lampblack is not installed."),
            QCoreApplication::translate(
                "lampblack", "Open a terminal in Lampblack's folder and type: make install. Then try again."),
            QStringLiteral("Python: %1 (named by %2)\n%3")
                .arg(interpreter.path.isEmpty() ? QStringLiteral("none") : interpreter.path,
                     interpreter.source, details)};
}

std::optional<UserError> whyUnusable(const Interpreter& interpreter)
{
    const QFileInfo python(interpreter.path);
    if (interpreter.path.isEmpty() || !python.isFile() || !python.isExecutable())
        return notInstalled(interpreter, QStringLiteral("There is no such program."));
    if (!isToInstall(interpreter))
        return std::nullopt;
    const QString version = installedVersion(interpreter);
    const QString has =
        QStringLiteral("Installed: \"%1\". Wanted: \"%2\".").arg(version, QStringLiteral(LAMPBLACK_VERSION));
    return version.isEmpty() ? notInstalled(interpreter, has) : versionMismatch(interpreter, has);
}

UserError versionMismatch(const Interpreter& interpreter, const QString& details)
{
    if (!interpreter.installer.isEmpty())
    {
        return {QCoreApplication::translate("lampblack",
                                            "The lamp's renderer is of another version than the lamp."),
                QCoreApplication::translate("lampblack", "Press Update in the lamp's panel."), details};
    }
    return {QCoreApplication::translate("lampblack", "The renderer is of another version than the plugin."),
            QCoreApplication::translate(
                "lampblack",
                "Update both together: open a terminal in Lampblack's folder and type: make install"),
            details};
}

} // namespace lampblack
