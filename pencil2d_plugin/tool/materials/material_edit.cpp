#include "tool/materials/material_edit.h"

#include <algorithm>

namespace lampblack
{

namespace
{
constexpr int MaxCorrectedColours = 256; // the schema's
}

Scene withMaterial(Scene scene, const QString& colour, const Material& material)
{
    if (material == scene.defaultMaterial)
        scene.materials.remove(colour);
    else
        scene.materials.insert(colour, material);
    return scene;
}

Scene withRoughness(Scene scene, double roughness)
{
    const double before = scene.defaultMaterial.roughness;
    for (Material& material : scene.materials)
    {
        if (qFuzzyCompare(material.roughness, before))
            material.roughness = roughness;
    }
    scene.defaultMaterial.roughness = roughness;
    return scene;
}

DepthColour correctionOf(const Scene& scene, const QString& colour)
{
    const QVector<DepthColour>& all = scene.depth.colours;
    const auto* found = std::find_if(
        all.begin(), all.end(), [&colour](const DepthColour& each) { return each.colour == QColor(colour); });
    DepthColour none;
    none.colour = QColor(colour);
    return found == all.end() ? none : *found;
}

Scene withCorrection(Scene scene, const DepthColour& correction)
{
    QVector<DepthColour>& all = scene.depth.colours;
    DepthColour none;
    none.colour = correction.colour;
    none.extra = correction.extra;
    auto* found =
        std::find_if(all.begin(), all.end(),
                     [&correction](const DepthColour& each) { return each.colour == correction.colour; });
    if (found != all.end())
        all.erase(found);
    if (!(correction == none) && all.size() < MaxCorrectedColours)
        all.append(correction);
    return scene;
}

} // namespace lampblack
