// A copy of the project beside it, from before our layer first went in.
#pragma once

#include <QString>

namespace lampblack
{

/// "walk.pclx" has "walk.backup.pclx".
QString backupOf(const QString& project);

/// Copy the project, the data folder of an old "walk.pcl" too. An older backup is replaced once the new one
/// is whole. Returns what went wrong; empty if nothing did. Waits for the disk.
QString backUp(const QString& project);

} // namespace lampblack
