// Members of C++ types into fields of JSON objects: the way back of json_reader.h.
#pragma once

#include <QJsonArray>
#include <QJsonObject>
#include <QMap>
#include <QStringList>
#include <QVector>

#include <array>
#include <optional>

namespace lampblack
{

/// Writes every field, whether or not it equals its default. Ranges were the reader's affair: the further
/// arguments of each function are let be.
class JsonWriter
{
public:
    const QJsonObject& tree() const { return mTree; }

    template <class Integer, class... Rule> void integer(const char* name, Integer& value, const Rule&...)
    {
        put(name, static_cast<qint64>(value));
    }

    template <class Integer, class... Rule>
    void integer(const char* name, std::optional<Integer>& value, const Rule&...)
    {
        put(name, value ? QJsonValue(static_cast<qint64>(*value)) : QJsonValue());
    }

    template <class... Rule> void real(const char* name, double& value, const Rule&...) { put(name, value); }
    template <class... Rule> void boolean(const char* name, bool& value, const Rule&...) { put(name, value); }
    template <class... Rule> void text(const char* name, QString& value, const Rule&...) { put(name, value); }

    template <class... Rule> void texts(const char* name, QStringList& values, const Rule&...)
    {
        put(name, QJsonArray::fromStringList(values));
    }

    template <class Enum, class Choices, class... Rule>
    void choice(const char* name, Enum& value, const Choices& choices, const Rule&...)
    {
        for (const auto& choice : choices)
        {
            if (choice.value == value)
            {
                put(name, QLatin1String(choice.name));
            }
        }
    }

    template <std::size_t Count, class... Rule>
    void reals(const char* name, std::array<double, Count>& values, const Rule&...)
    {
        QJsonArray array;
        for (const double value : values)
        {
            array.append(value);
        }
        put(name, array);
    }

    template <class... Rule> void reals(const char* name, QVector<double>& values, const Rule&...)
    {
        QJsonArray array;
        for (const double value : values)
        {
            array.append(value);
        }
        put(name, array);
    }

    template <class T, class... Rule> void object(const char* name, T& value, const Rule&...)
    {
        put(name, write(value));
    }

    template <class T> void object(const char* name, std::optional<T>& value)
    {
        put(name, value ? QJsonValue(write(*value)) : QJsonValue());
    }

    template <class T, class... Rule> void list(const char* name, QVector<T>& values, const Rule&...)
    {
        QJsonArray array;
        for (T& value : values)
        {
            array.append(write(value));
        }
        put(name, array);
    }

    template <class T> void listIfAny(const char* name, QVector<T>& values, int most)
    {
        if (!values.isEmpty())
        {
            list(name, values, most);
        }
    }

    template <class T, class... Rule> void map(const char* name, QMap<QString, T>& values, const Rule&...)
    {
        QJsonObject object;
        for (auto item = values.begin(); item != values.end(); ++item)
        {
            object.insert(item.key(), write(item.value()));
        }
        put(name, object);
    }

    /// Fields of versions to come stand beside ours, and never in their place.
    void rest(const QJsonObject& extra)
    {
        for (auto item = extra.begin(); item != extra.end(); ++item)
        {
            if (!mTree.contains(item.key()))
            {
                mTree.insert(item.key(), item.value());
            }
        }
    }

protected:
    void put(const char* name, const QJsonValue& value) { mTree.insert(QLatin1String(name), value); }

private:
    template <class T> static QJsonObject write(T& value)
    {
        JsonWriter writer;
        describe(writer, value);
        return writer.tree();
    }

    QJsonObject mTree;
};

} // namespace lampblack
