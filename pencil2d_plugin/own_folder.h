// Temporary folders that do not outlive their process for long.
#pragma once

#include <QCoreApplication>
#include <QDir>
#include <QString>

namespace lampblack
{

/// For a QTemporaryDir: named after this process, so that the worker's next renderer removes what a Pencil2D
/// that was killed has left (`lampblack/own_folder.py` knows the name).
inline QString ownFolderTemplate()
{
    return QDir::temp().filePath(
        QStringLiteral("lampblack-%1-qtXXXXXX").arg(QCoreApplication::applicationPid()));
}

} // namespace lampblack
