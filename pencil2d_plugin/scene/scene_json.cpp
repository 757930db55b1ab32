#include "scene/generated/scene_fields.h"
#include "scene/json_writer.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lampblack
{
namespace
{

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

    void reals(const char* name, QVector<double>& values, int most, double low, double high,
               Need need = Need::Required)
    {
        values.resize(qMin(most, values.size()));
        for (double& value : values)
        {
            real(name, value, low, high, need);
        }
    }

    void boolean(const char* /*name*/, bool& /*value*/, Need /*need*/) {}
    template <class... Rule> void text(const char* /*name*/, QString& /*value*/, const Rule&... /*rule*/) {}
    void texts(const char* /*name*/, QStringList& values, int most, int longest,
               const QRegularExpression& pattern, Need /*need*/ = Need::Required)
    {
        const auto wrong = [&](const QString& value)
        {
            return value.size() > longest || !pattern.match(value).hasMatch();
        };
        values.erase(std::remove_if(values.begin(), values.end(), wrong), values.end());
        while (values.size() > most)
        {
            values.removeLast();
        }
    }
    template <class Enum, class... Rule>
    void choice(const char* /*name*/, Enum& /*value*/, const Rule&... /*rule*/)
    {
    }
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

    template <class T>
    void list(const char* /*name*/, QVector<T>& values, int most, Need /*need*/ = Need::Required)
    {
        values.resize(qMin(most, values.size()));
        for (T& value : values)
        {
            describe(*this, value);
        }
    }

    template <class T> void listIfAny(const char* name, QVector<T>& values, int most)
    {
        list(name, values, most);
    }

    template <class T>
    void map(const char* /*name*/, QMap<QString, T>& values, int most, const QRegularExpression& keys,
             Need /*need*/ = Need::Required)
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

} // namespace

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

namespace
{

template <class Thing> std::optional<Thing> fromJson(const QJsonObject& tree, QString* fault)
{
    JsonReader reader(tree);
    Thing thing;
    describe(reader, thing);
    if (reader.fault().isEmpty())
    {
        return thing;
    }
    if (fault != nullptr)
    {
        *fault = reader.fault();
    }
    return std::nullopt;
}

} // namespace

std::optional<Scene> sceneFromJson(const QJsonObject& tree, QString* fault)
{
    return fromJson<Scene>(tree, fault);
}

QJsonObject toJson(const Rig& rig)
{
    JsonWriter writer;
    Rig copy = rig;
    describe(writer, copy);
    return writer.tree();
}

std::optional<Rig> rigFromJson(const QJsonObject& tree, QString* fault)
{
    return fromJson<Rig>(tree, fault);
}

std::optional<Style> styleFromJson(const QJsonObject& tree, QString* fault)
{
    return fromJson<Style>(tree, fault);
}

} // namespace lampblack
