// A backup of the project, made before Lampblack first puts a layer into it.
#pragma once

#include <QString>

namespace lampblack
{

/// The backup of "walk.pclx" is "walk.backup.pclx", in the same folder.
QString backupPath(const QString& project);

/// Copy the project, and the data folder of an old "walk.pcl". A new backup replaces an older one when it is
/// complete. Returns an error message, empty on success. Blocks while it reads and writes.
QString backUpProject(const QString& project);

} // namespace lampblack
