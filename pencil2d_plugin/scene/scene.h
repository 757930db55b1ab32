// The scene as one value (protocol/scene.schema.json), what a new one is like, and its way to JSON and back.
#pragma once

#include "scene/generated/scene_types.h"

#include <QSize>

namespace lampblack
{

inline bool operator!=(const Scene& a, const Scene& b)
{
    return !(a == b);
}

/// The material of the flat colour "#rrggbb".
Material materialOf(const Scene& scene, const QString& colour);

inline QSize sizeOf(const Canvas& canvas)
{
    return {canvas.width, canvas.height};
}

/// Height of a light above the paper at which power 1 is calibrated, canvas pixels.
double defaultHeight(const Canvas& canvas);

/// A white light over (x, y) at the default height, as `default_light` in Python makes it.
AreaLight defaultLight(const Canvas& canvas, double x, double y);

/// One light above the upper left of the canvas, no floor.
Scene defaultScene(const QSize& canvas);

/// The nearest scene within the schema's ranges; materials under keys that are no colour are left out.
Scene clamped(const Scene& scene);

/// Rigs and styles as JSON and back, as for scenes below.
QJsonObject toJson(const Rig& rig);
std::optional<Rig> rigFromJson(const QJsonObject& tree, QString* fault = nullptr);
std::optional<Style> styleFromJson(const QJsonObject& tree, QString* fault = nullptr);

/// The scene as JSON, unknown fields included, defaults spelled out.
QJsonObject toJson(const Scene& scene);

/// The same scene with the fields of materials left out that equal their defaults.
QJsonObject toShortJson(const Scene& scene);

/// Read a scene; on failure returns nothing and says in `fault`, if given, which field and why.
std::optional<Scene> sceneFromJson(const QJsonObject& tree, QString* fault = nullptr);

} // namespace lampblack
