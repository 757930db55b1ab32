#include "plugin/backup.h"

#include <QDir>
#include <QDirIterator>
#include <QFileInfo>
#include <QSaveFile>

namespace lampblack
{

namespace
{

const QString DataSuffix = QStringLiteral(".data"); ///< of the folder beside an old project

QString copyWhole(const QString& from, const QString& to)
{
    constexpr qint64 ChunkBytes = 1 << 20;
    QFile source(from);
    QSaveFile target(to);
    if (!source.open(QFile::ReadOnly))
        return QStringLiteral("%1: %2").arg(from, source.errorString());
    if (!target.open(QFile::WriteOnly))
        return QStringLiteral("%1: %2").arg(to, target.errorString());
    while (!source.atEnd())
    {
        const QByteArray chunk = source.read(ChunkBytes);
        if (chunk.isEmpty() || target.write(chunk) != chunk.size())
            return QStringLiteral("%1: %2 %3").arg(to, source.errorString(), target.errorString());
    }
    return target.commit() ? QString() : QStringLiteral("%1: %2").arg(to, target.errorString());
}

QString copyFolder(const QString& from, const QString& to)
{
    QDirIterator files(from, QDir::Files);
    while (files.hasNext())
    {
        const QString file = files.next();
        if (!QDir().mkpath(to))
            return to;
        if (QString error = copyWhole(file, QDir(to).filePath(files.fileName())); !error.isEmpty())
            return error;
    }
    return {};
}

} // namespace

QString backupPath(const QString& project)
{
    const QFileInfo file(project);
    return file.dir().filePath(file.completeBaseName() + QStringLiteral(".backup.") + file.suffix());
}

QString backUpProject(const QString& project)
{
    const QString error = copyFolder(project + DataSuffix, backupPath(project) + DataSuffix);
    return error.isEmpty() ? copyWhole(project, backupPath(project)) : error;
}

} // namespace lampblack
