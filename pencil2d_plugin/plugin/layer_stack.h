// The layers of a drawing, sorted by what the light makes of them.
#pragma once

#include "host/host.h"
#include "scene/layer_roles.h"

namespace lampblack
{

/// Names of layers, top first.
struct LayerStack
{
    QStringList above; ///< shown as drawn, over what is lit
    QStringList lit;   ///< characters and their lines
    QStringList below; ///< shown as drawn, under what is lit
};

/// Sorts what is visible, as the worker's command line does. Sources that were hidden behind the layer of
/// results are lit all the same if they have a role; the layer of results is left out.
LayerStack stackLayers(const QVector<Layer>& layers, const LayerRoles& roles);

} // namespace lampblack
