// The layers of a drawing, sorted into lit and unlit ones.
#pragma once

#include "host/host.h"
#include "scene/layer_roles.h"

namespace lampblack
{

/// Names of layers, top first.
struct LayerStack
{
    QStringList above; ///< shown as drawn, over the lit layers
    QStringList lit;   ///< characters and their lines
    QStringList below; ///< shown as drawn, under the lit layers
    QStringList light; ///< whose paint is light; they are not shown
};

/// Sort the visible layers by the rules of the worker's command line. Result layers are left out. While the
/// result is visible, hidden layers are lit too if they have a role: it was rendered from them.
LayerStack sortLayers(const QVector<Layer>& layers, const LayerRoles& roles);

} // namespace lampblack
