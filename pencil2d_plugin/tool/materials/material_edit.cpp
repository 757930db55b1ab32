#include "tool/materials/material_edit.h"

namespace lampblack
{

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

} // namespace lampblack
