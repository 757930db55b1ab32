// The scene's fields and ranges, as protocol/scene.schema.json has them.
#include "scene/json_reader.h"
#include "scene/json_writer.h"
#include "scene/scene.h"

#include <cmath>
#include <iterator>

namespace lampblack
{
namespace
{

constexpr double Far = 1e5; // canvas pixels
constexpr int LastFrame = 999999;

const QRegularExpression& colourPattern()
{
    static const QRegularExpression pattern(QStringLiteral("^#[0-9a-f]{6}$(?!\\n)"));
    return pattern;
}

constexpr std::array<Choice<Quality>, 3> Qualities = {
    {{"low", Quality::Low}, {"medium", Quality::Medium}, {"final", Quality::Final}}};

constexpr int MaxMaterials = 4096;

/// Brings members into the ranges that describe() states.
class Clamp
{
public:
    void integer(const char* /*name*/, int& value, int low, int high, Need /*need*/ = Need::Required)
    {
        value = qBound(low, value, high);
    }

    void real(const char* /*name*/, double& value, double low, double high, Need /*need*/ = Need::Required)
    {
        value = qBound(low, std::isnan(value) ? 0 : value, high);
    }

    void boolean(const char* /*name*/, bool& /*value*/, Need /*need*/) {}
    template <class... Rule> void text(const char* /*name*/, QString& /*value*/, const Rule&... /*rule*/) {}
    template <class... Rule> void choice(const char* /*name*/, Quality& /*value*/, const Rule&... /*rule*/) {}
    void rest(const QJsonObject& /*extra*/) {}

    template <class T> void object(const char* /*name*/, T& value, Need /*need*/ = Need::Required)
    {
        describe(*this, value);
    }

    template <class T> void object(const char* /*name*/, std::optional<T>& value)
    {
        if (value)
        {
            describe(*this, *value);
        }
    }

    template <class T> void list(const char* /*name*/, QVector<T>& values, int most, Need /*need*/)
    {
        values.resize(qMin(most, values.size()));
        for (T& value : values)
        {
            describe(*this, value);
        }
    }

    template <class T> void listIfAny(const char* name, QVector<T>& values, int most)
    {
        list(name, values, most, Need::Optional);
    }

    template <class T>
    void map(const char* /*name*/, QMap<QString, T>& values, int most, const QRegularExpression& keys)
    {
        for (auto item = values.begin(); item != values.end();)
        {
            describe(*this, item.value());
            item = keys.match(item.key()).hasMatch() ? std::next(item) : values.erase(item);
        }
        while (values.size() > most)
        {
            values.erase(std::prev(values.end()));
        }
    }
};

struct Canvas
{
    int width = 1;
    int height = 1;
    QJsonObject extra;
};

template <class Fields> void colour(Fields& fields, QColor& value)
{
    QString text = value.name();
    fields.text("colour", text, 7, 7, colourPattern(), Need::Optional);
    value = QColor(text);
}

template <class Fields> void describe(Fields& fields, Canvas& canvas)
{
    fields.integer("width", canvas.width, 1, 65536);
    fields.integer("height", canvas.height, 1, 65536);
    fields.rest(canvas.extra);
}

} // namespace

/// What a light and its keys have in common.
template <class Fields, class Light> void look(Fields& fields, Light& light)
{
    fields.real("x", light.x, -Far, Far);
    fields.real("y", light.y, -Far, Far);
    fields.real("z", light.z, -Far, Far);
    fields.real("size", light.size, 1, Far, Need::Optional);
    colour(fields, light.colour);
    fields.real("power", light.power, 0, 100, Need::Optional);
}

/// What a floor and its keys have in common.
template <class Fields, class Plane> void lie(Fields& fields, Plane& floor)
{
    fields.real("y", floor.y, -Far, Far);
    fields.real("pitch", floor.pitch, 5, 85, Need::Optional);
}

template <class Fields> void describe(Fields& fields, LightKey& key)
{
    fields.integer("frame", key.frame, 0, LastFrame);
    look(fields, key);
    fields.rest(key.extra);
}

template <class Fields> void describe(Fields& fields, AreaLight& light)
{
    look(fields, light);
    fields.listIfAny("keys", light.keys, MaxKeys);
    fields.rest(light.extra);
}

template <class Fields> void describe(Fields& fields, Ambient& ambient)
{
    colour(fields, ambient.colour);
    fields.real("strength", ambient.strength, 0, 100, Need::Optional);
    fields.rest(ambient.extra);
}

template <class Fields> void describe(Fields& fields, Material& material)
{
    fields.boolean("diffuse", material.diffuse, Need::Optional);
    fields.boolean("glossy", material.glossy, Need::Optional);
    fields.real("gloss", material.gloss, 0, 1, Need::Optional);
    fields.real("roughness", material.roughness, 0.02, 1, Need::Optional);
    fields.rest(material.extra);
}

template <class Fields> void describe(Fields& fields, FloorKey& key)
{
    fields.integer("frame", key.frame, 0, LastFrame);
    lie(fields, key);
    fields.rest(key.extra);
}

template <class Fields> void describe(Fields& fields, Floor& floor)
{
    lie(fields, floor);
    fields.listIfAny("keys", floor.keys, MaxKeys);
    fields.rest(floor.extra);
}

template <class Fields> void describe(Fields& fields, Scene& scene)
{
    int version = 1;
    Canvas canvas = {scene.canvas.width(), scene.canvas.height(), scene.canvasExtra};
    fields.integer("version", version, 1, 1, Need::Optional);
    fields.object("canvas", canvas);
    fields.list("lights", scene.lights, MaxLights, Need::Optional);
    fields.object("ambient", scene.ambient, Need::Optional);
    fields.map("materials", scene.materials, MaxMaterials, colourPattern());
    fields.object("default_material", scene.defaultMaterial, Need::Optional);
    fields.object("floor", scene.floor);
    fields.real("relief_scale", scene.reliefScale, 0.01, 10, Need::Optional);
    fields.choice("quality", scene.quality, Qualities, Need::Optional);
    fields.rest(scene.extra);
    scene.canvas = QSize(canvas.width, canvas.height);
    scene.canvasExtra = canvas.extra;
}

Scene clamped(const Scene& scene)
{
    Clamp clamp;
    Scene copy = scene;
    describe(clamp, copy);
    return copy;
}

QJsonObject toJson(const Scene& scene)
{
    JsonWriter writer;
    Scene copy = scene;
    describe(writer, copy);
    return writer.tree();
}

QJsonObject toShortJson(const Scene& scene)
{
    JsonWriter plain;
    Material unset;
    describe(plain, unset);
    QJsonObject tree = toJson(scene);
    QJsonObject materials = tree.value(QLatin1String("materials")).toObject();
    for (auto item = materials.begin(); item != materials.end(); ++item)
    {
        QJsonObject material = item.value().toObject();
        for (const QString& field : plain.tree().keys())
        {
            if (material.value(field) == plain.tree().value(field))
            {
                material.remove(field);
            }
        }
        item.value() = material;
    }
    tree.insert(QLatin1String("materials"), materials);
    return tree;
}

std::optional<Scene> sceneFromJson(const QJsonObject& tree, QString* fault)
{
    JsonReader reader(tree);
    Scene scene;
    describe(reader, scene);
    if (reader.fault().isEmpty())
    {
        return scene;
    }
    if (fault != nullptr)
    {
        *fault = reader.fault();
    }
    return std::nullopt;
}

} // namespace lampblack
