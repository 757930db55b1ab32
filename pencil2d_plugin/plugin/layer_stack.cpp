#include "plugin/layer_stack.h"

#include <algorithm>

namespace lampblack
{

LayerStack sortLayers(const QVector<Layer>& layers, const LayerRoles& roles)
{
    const bool hasResult =
        std::any_of(layers.begin(), layers.end(),
                    [&](const Layer& layer) { return layer.visible && isResult(layer.name, roles); });
    LayerStack stack;
    for (const Layer& layer : layers)
    {
        const bool isDrawing = layer.kind == Layer::Kind::Bitmap || layer.kind == Layer::Kind::Vector;
        if (!isDrawing || isResult(layer.name, roles))
            continue;
        if (isLight(layer.name, roles))
        {
            if (layer.visible)
                stack.light.append(layer.name);
            continue;
        }
        const bool isShown = layer.visible || (hasResult && roles.contains(layer.name));
        if (roleOf(layer.name, roles) != QLatin1String("background"))
        {
            if (isShown)
                stack.lit.append(layer.name);
        }
        else if (layer.visible)
        {
            // A background between two lit layers is shown under both.
            (stack.lit.isEmpty() ? stack.above : stack.below).append(layer.name);
        }
    }
    return stack;
}

} // namespace lampblack
