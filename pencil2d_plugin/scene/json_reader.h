// Fields of JSON objects into members of C++ types, strictly, and back.
//
// A type says once what its fields are, by a function found beside it,
//     template <class Fields> void describe(Fields& fields, T& value);
// which JsonReader and JsonWriter walk alike. A field that may be left out keeps the member's value.
#pragma once

#include <QJsonArray>
#include <QJsonObject>
#include <QMap>
#include <QRegularExpression>
#include <QStringList>
#include <QVector>

#include <array>
#include <optional>

namespace lampblack
{

enum class Need
{
    Required,
    Optional
};

/// A value of an enumeration and its name in JSON.
template <class Enum> struct Choice
{
    const char* name;
    Enum value;
};

class JsonReader
{
public:
    explicit JsonReader(const QJsonObject& tree) : mTree(tree) {}

    /// Which field is at fault and why; empty while all is well. Only the first one is kept.
    const QString& fault() const { return mFault; }

    template <class Integer>
    void integer(const char* name, Integer& value, double low, double high, Need need = Need::Required)
    {
        if (const std::optional<double> number = takeNumber(name, low, high, true, need))
        {
            value = static_cast<Integer>(*number);
        }
    }

    /// null and absence are nothing.
    template <class Integer>
    void integer(const char* name, std::optional<Integer>& value, double low, double high)
    {
        value.reset();
        if (wanted(name, Need::Optional) && !at(name).isNull())
        {
            integer(name, value.emplace(), low, high);
        }
    }

    void real(const char* name, double& value, double low, double high, Need need = Need::Required);
    void boolean(const char* name, bool& value, Need need = Need::Required);

    /// Lengths are in code points.
    void text(const char* name, QString& value, int shortest, int longest, const QRegularExpression& pattern,
              Need need = Need::Required);
    void text(const char* name, QString& value, int shortest, int longest, Need need = Need::Required);
    void texts(const char* name, QStringList& values, int most, int longest,
               const QRegularExpression& pattern, Need need = Need::Required);

    template <class Enum, std::size_t Count>
    void choice(const char* name, Enum& value, const std::array<Choice<Enum>, Count>& choices,
                Need need = Need::Required)
    {
        if (!wanted(name, need))
        {
            return;
        }
        for (const Choice<Enum>& choice : choices)
        {
            if (at(name).isString() && at(name).toString() == QLatin1String(choice.name))
            {
                value = choice.value;
                return;
            }
        }
        refuse(name, "not one of the known words");
    }

    template <std::size_t Count>
    void reals(const char* name, std::array<double, Count>& values, double low, double high,
               Need need = Need::Required)
    {
        const int count = static_cast<int>(Count);
        if (const std::optional<QJsonArray> array = takeArray(name, count, count, need))
        {
            for (int i = 0; i < count; ++i)
            {
                values.at(static_cast<std::size_t>(i)) = realOf(name, array->at(i), low, high);
            }
        }
    }

    void reals(const char* name, QVector<double>& values, int most, double low, double high,
               Need need = Need::Required);

    template <class T> void object(const char* name, T& value, Need need = Need::Required)
    {
        if (wanted(name, need))
        {
            read(name, at(name), value);
        }
    }

    /// null and absence are nothing.
    template <class T> void object(const char* name, std::optional<T>& value)
    {
        value.reset();
        if (wanted(name, Need::Optional) && !at(name).isNull())
        {
            object(name, value.emplace());
        }
    }

    template <class T> void list(const char* name, QVector<T>& values, int most, Need need = Need::Required)
    {
        const std::optional<QJsonArray> array = takeArray(name, 0, most, need);
        if (!array)
        {
            return;
        }
        values.resize(array->size());
        for (int i = 0; i < array->size(); ++i)
        {
            read(name, array->at(i), values[i]);
        }
    }

    /// Left out where it is empty.
    template <class T> void listIfAny(const char* name, QVector<T>& values, int most)
    {
        list(name, values, most, Need::Optional);
    }

    template <class T>
    void map(const char* name, QMap<QString, T>& values, int most, const QRegularExpression& keys,
             Need need = Need::Required)
    {
        if (!wanted(name, need))
        {
            return;
        }
        const QJsonObject tree = at(name).toObject();
        if (!at(name).isObject() || tree.size() > most)
        {
            refuse(name, "not an object, or too large");
            return;
        }
        values.clear();
        for (auto item = tree.begin(); item != tree.end(); ++item)
        {
            if (!keys.match(item.key()).hasMatch())
            {
                refuse(name, "a key that is not allowed");
                return;
            }
            read(name, item.value(), values[item.key()]);
        }
    }

    /// What was not asked for before: fields of versions to come.
    void rest(QJsonObject& extra);

protected:
    QJsonValue at(const char* name) const { return mTree.value(QLatin1String(name)); }
    bool has(const char* name) const { return mTree.contains(QLatin1String(name)); }
    bool wanted(const char* name, Need need);
    void refuse(const char* name, const char* why);
    void refuse(const char* name, const QString& rest);

private:
    /// The list in a field; none if the field is absent, or refused.
    std::optional<QJsonArray> takeArray(const char* name, int least, int most, Need need);
    double realOf(const char* name, const QJsonValue& item, double low, double high);
    std::optional<double> takeNumber(const char* name, double low, double high, bool whole, Need need);

    template <class T> void read(const char* name, const QJsonValue& item, T& value)
    {
        if (!item.isObject())
        {
            refuse(name, "not an object");
            return;
        }
        JsonReader reader(item.toObject());
        describe(reader, value);
        if (!reader.fault().isEmpty())
        {
            refuse(name, QLatin1Char('.') + reader.fault());
        }
    }

    QJsonObject mTree;
    QStringList mAsked;
    QString mFault;
};

} // namespace lampblack
