// Imports a layer through Pencil2D's own import dialog, without showing it.
#pragma once

#include "host/parts.h"

namespace lampblack
{

/// Import the layer `layer` of the project file `project` on top of all others. The current layer and the
/// undo history stay. Returns an error message, empty on success. Blocks while Pencil2D reads the file.
QString importLayer(const Parts& parts, const QString& project, const QString& layer);

} // namespace lampblack
