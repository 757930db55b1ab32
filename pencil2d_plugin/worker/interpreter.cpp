#include "worker/interpreter.h"

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
        const QString path =
            QJsonDocument::fromJson(note.read(MaxBytes)).object().value(QLatin1String("python")).toString();
        return {QDir::isAbsolutePath(path) ? path : QString(), note.fileName()};
    }
    const QString path = QDir(folder).filePath(QStringLiteral("../../../.venv/bin/python"));
    return {QDir::cleanPath(path), QStringLiteral("the source tree")};
}

UserError notInstalled(const Interpreter& interpreter, const QString& details)
{
    return {QCoreApplication::translate("lampblack", "Lampblack's worker is not installed."),
            QCoreApplication::translate(
                "lampblack", "Open a terminal in Lampblack's folder and type: make install. Then try again."),
            QStringLiteral("Python: %1 (named by %2)\n%3")
                .arg(interpreter.path.isEmpty() ? QStringLiteral("none") : interpreter.path,
                     interpreter.source, details)};
}

UserError versionMismatch(const QString& details)
{
    return {
        QCoreApplication::translate("lampblack", "Lampblack's worker is of another version than its plugin."),
        QCoreApplication::translate(
            "lampblack",
            "Update both together: open a terminal in Lampblack's folder and type: make install"),
        details};
}

} // namespace lampblack
