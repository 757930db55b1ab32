// The Python that runs the worker.
#pragma once

#include "user_error.h"

#include <QString>

#include <optional>

namespace lampblack
{

struct Interpreter
{
    QString path;           ///< absolute; empty if none was named
    QString source;         ///< where it was named, for people
    QString installer = {}; ///< folder of what installs it; empty if it was not installed by us
};

/// The folder that our own shared object (or program) was loaded from.
QString pluginFolder();

/// The interpreter named by LAMPBLACK_PYTHON, else what `folder`/lampblack.json says: "python" names one, and
/// "installer" the folder of an installer, whose interpreter is in the user's data folder. Else that of the
/// source tree which `folder` was built in.
Interpreter findInterpreter(const QString& folder = pluginFolder());

/// Whether there is an installer, and it has not installed a worker of this plugin's version.
bool isToInstall(const Interpreter& interpreter);

/// The version of the worker that `interpreter`'s installer finished; empty if there is none.
QString installedVersion(const Interpreter& interpreter);

/// What is said when `interpreter` cannot run a worker.
UserError notInstalled(const Interpreter& interpreter, const QString& details);

/// Why nothing can be run by `interpreter`; no value if something can.
std::optional<UserError> whyUnusable(const Interpreter& interpreter);

/// What is said when plugin and worker do not speak the same protocol.
UserError versionMismatch(const Interpreter& interpreter, const QString& details);

} // namespace lampblack
