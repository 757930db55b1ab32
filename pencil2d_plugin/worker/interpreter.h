// The Python that runs the worker.
#pragma once

#include "user_error.h"

#include <QString>

namespace lampblack
{

struct Interpreter
{
    QString path;   ///< absolute; empty if none was named
    QString source; ///< where it was named, for people
};

/// The folder that our own shared object (or program) was loaded from.
QString pluginFolder();

/// The interpreter named by LAMPBLACK_PYTHON, else by "python" in `folder`/lampblack.json, which the
/// installer writes, else that of the source tree which `folder` was built in.
Interpreter findInterpreter(const QString& folder = pluginFolder());

/// What is said when `interpreter` cannot run a worker.
UserError notInstalled(const Interpreter& interpreter, const QString& details);

/// What is said when plugin and worker do not speak the same protocol.
UserError versionMismatch(const QString& details);

} // namespace lampblack
