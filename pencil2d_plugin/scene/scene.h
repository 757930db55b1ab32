// The scene: everything that says how drawings are lit, as one value.
//
// Canvas frame, in the drawing's own pixels: x right, y down, origin at the drawing's top left
// corner, z towards the viewer, the paper at z = 0. Colours are sRGB. The tree goes to JSON and
// back (protocol/scene.schema.json); fields that this version does not know are kept in `extra`
// and written out again. Ranges and defaults are the schema's.
#pragma once

#include <QColor>
#include <QJsonObject>
#include <QMap>
#include <QSize>
#include <QString>
#include <QVector>

#include <optional>

namespace lampblack
{

constexpr int MaxLights = 4;
constexpr int MaxKeys = 128; ///< of a light or a floor

/// What a light is like at one frame.
struct LightKey
{
    int frame = 0; ///< 0 to 999999
    double x = 0;
    double y = 0;
    double z = 0;
    double size = 200;
    QColor colour = Qt::white;
    double power = 1;
    QJsonObject extra;
};

/// A disk of light facing the paper point beneath it; z below 0 stands behind the paper. With keys, its own
/// values count for nothing: see timeline.h.
struct AreaLight
{
    double x = 0;
    double y = 0;
    double z = 0;
    double size = 200; ///< diameter, canvas pixels
    QColor colour = Qt::white;
    double power = 1;
    QVector<LightKey> keys = {}; ///< in any order; of two at one frame the last counts
    QJsonObject extra;
};

struct Ambient
{
    QColor colour = Qt::white;
    double strength = 0.3;
    QJsonObject extra;
};

/// Diffuse, glossy, both, or neither (left as drawn).
struct Material
{
    bool diffuse = true;
    bool glossy = false;
    double gloss = 0.5;     ///< amount, 0 to 1
    double roughness = 0.3; ///< 0.02 (mirror) to 1 (satin)
    QJsonObject extra;
};

/// How a floor lies at one frame.
struct FloorKey
{
    int frame = 0; ///< 0 to 999999
    double y = 0;
    double pitch = 25;
    QJsonObject extra;
};

/// A shadow catcher hinged at the canvas line y, z = 0, pitched towards the viewer. Keys are as a light's.
struct Floor
{
    double y = 0;
    double pitch = 25; ///< degrees, 5 to 85
    QVector<FloorKey> keys = {};
    QJsonObject extra = {};
};

enum class Quality
{
    Low,
    Medium,
    Final
};

struct Scene
{
    QSize canvas = QSize(1, 1);
    QJsonObject canvasExtra;
    QVector<AreaLight> lights;
    Ambient ambient;
    QMap<QString, Material> materials; ///< keyed by "#rrggbb", lower case
    Material defaultMaterial;
    std::optional<Floor> floor;
    double reliefScale = 1;
    Quality quality = Quality::Low;
    QJsonObject extra;

    /// What the flat colour "#rrggbb" wears.
    Material material(const QString& colour) const { return materials.value(colour, defaultMaterial); }

    /// Height of a light above the paper at which power 1 is calibrated, canvas pixels.
    double defaultHeight() const { return qMax(canvas.width(), canvas.height()) / 2.0; }
};

bool operator==(const LightKey& a, const LightKey& b);
bool operator==(const AreaLight& a, const AreaLight& b);
bool operator==(const Ambient& a, const Ambient& b);
bool operator==(const Material& a, const Material& b);
bool operator==(const FloorKey& a, const FloorKey& b);
bool operator==(const Floor& a, const Floor& b);
bool operator==(const Scene& a, const Scene& b);
inline bool operator!=(const Scene& a, const Scene& b)
{
    return !(a == b);
}

/// A white light over (x, y) at the default height, as scene.py makes it.
AreaLight defaultLight(const QSize& canvas, double x, double y);

/// One light above the upper left of the canvas, no floor.
Scene defaultScene(const QSize& canvas);

/// The nearest scene within the schema's ranges; materials under keys that are no colour are left out.
Scene clamped(const Scene& scene);

/// The scene as JSON, unknown fields included, defaults spelled out.
QJsonObject toJson(const Scene& scene);

/// The same scene with the fields of materials left out that equal their defaults.
QJsonObject toShortJson(const Scene& scene);

/// Read a scene; on failure returns nothing and says in `fault`, if given, which field and why.
std::optional<Scene> sceneFromJson(const QJsonObject& tree, QString* fault = nullptr);

} // namespace lampblack
