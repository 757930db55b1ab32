#include "worker/interpreter.h"

#include "worker/installer.h"

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>

#include <dlfcn.h>

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
    if (dladdr(&anchor, &found) == 0 || found.dli_fname == nullptr)
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
