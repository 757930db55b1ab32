#include "plugin/layer_stack.h"

#include <algorithm>

namespace lampblack
{

LayerStack stackLayers(const QVector<Layer>& layers, const LayerRoles& roles)
{
    const bool finished =
        std::any_of(layers.begin(), layers.end(),
                    [&](const Layer& layer) { return layer.visible && isResult(layer.name, roles); });
    LayerStack stack;
    for (const Layer& layer : layers)
    {
        const bool drawn = layer.kind == Layer::Kind::Bitmap || layer.kind == Layer::Kind::Vector;
        if (!drawn || isResult(layer.name, roles))
            continue;
        const bool counts = layer.visible || (finished && roles.contains(layer.name));
        if (roleOf(layer.name, roles) != QLatin1String("background"))
        {
            if (counts)
                stack.lit.append(layer.name);
        }
        else if (layer.visible)
        {
            // What lies between two lit layers is under both.
            (stack.lit.isEmpty() ? stack.above : stack.below).append(layer.name);
        }
    }
    return stack;
}

} // namespace lampblack
