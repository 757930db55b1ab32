// A layer into the open project, by its own import of layers, unseen.
#pragma once

#include "host/parts.h"

namespace lampblack
{

/// Import the layer `layer` of the project file `project`, on top of all. The current layer and the undo
/// history stay. Returns what went wrong; empty if nothing did. Blocks for as long as Pencil2D reads.
QString importLayer(const Parts& parts, const QString& project, const QString& layer);

} // namespace lampblack
