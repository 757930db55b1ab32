#include "scene/json_reader.h"

#include <cmath>

namespace lampblack
{

void JsonReader::real(const char* name, double& value, double low, double high, Need need)
{
    if (const std::optional<double> number = takeNumber(name, low, high, false, need))
    {
        value = *number;
    }
}

void JsonReader::boolean(const char* name, bool& value, Need need)
{
    if (!wanted(name, need))
    {
        return;
    }
    if (!at(name).isBool())
    {
        refuse(name, "neither true nor false");
    }
    value = at(name).toBool();
}

void JsonReader::text(const char* name, QString& value, int shortest, int longest, Need need)
{
    if (!wanted(name, need))
    {
        return;
    }
    value = at(name).toString();
    const int length = value.toUcs4().size();
    if (!at(name).isString() || length < shortest || length > longest)
    {
        refuse(name, QStringLiteral(": not a text of %1 to %2 characters").arg(shortest).arg(longest));
    }
}

void JsonReader::text(const char* name, QString& value, int shortest, int longest,
                      const QRegularExpression& pattern, Need need)
{
    text(name, value, shortest, longest, need);
    if (has(name) && !pattern.match(value).hasMatch())
    {
        refuse(name, QStringLiteral(": not of the form %1").arg(pattern.pattern()));
    }
}

void JsonReader::texts(const char* name, QStringList& values, int most, int longest,
                       const QRegularExpression& pattern, Need need)
{
    const std::optional<QJsonArray> array = takeArray(name, 0, most, need);
    if (!array)
    {
        return;
    }
    values.clear();
    for (const QJsonValue& item : *array)
    {
        values.append(item.toString());
        if (!item.isString() || values.last().toUcs4().size() > longest ||
            !pattern.match(values.last()).hasMatch())
        {
            refuse(name, "not a list of names");
        }
    }
}

void JsonReader::reals(const char* name, QVector<double>& values, int most, double low, double high,
                       Need need)
{
    const std::optional<QJsonArray> array = takeArray(name, 0, most, need);
    if (!array)
    {
        return;
    }
    values.clear();
    for (const QJsonValue& item : *array)
    {
        values.append(realOf(name, item, low, high));
    }
}

void JsonReader::rest(QJsonObject& extra)
{
    extra = mTree;
    for (const QString& name : qAsConst(mAsked))
    {
        extra.remove(name);
    }
}

bool JsonReader::wanted(const char* name, Need need)
{
    mAsked.append(QLatin1String(name));
    if (need == Need::Required && !has(name))
    {
        refuse(name, "missing");
    }
    return has(name);
}

void JsonReader::refuse(const char* name, const char* why)
{
    refuse(name, QLatin1String(": ") + QLatin1String(why));
}

void JsonReader::refuse(const char* name, const QString& rest)
{
    if (mFault.isEmpty())
    {
        mFault = QLatin1String(name) + rest;
    }
}

std::optional<QJsonArray> JsonReader::takeArray(const char* name, int least, int most, Need need)
{
    if (!wanted(name, need))
    {
        return std::nullopt;
    }
    const QJsonArray array = at(name).toArray();
    if (!at(name).isArray() || array.size() < least || array.size() > most)
    {
        refuse(name, "not a list, or of the wrong length");
        return std::nullopt;
    }
    return array;
}

double JsonReader::realOf(const char* name, const QJsonValue& item, double low, double high)
{
    const double number = item.toDouble();
    if (!item.isDouble() || number < low || number > high)
    {
        refuse(name, "not numbers in their range");
    }
    return number;
}

std::optional<double> JsonReader::takeNumber(const char* name, double low, double high, bool whole, Need need)
{
    if (!wanted(name, need))
    {
        return std::nullopt;
    }
    const double number = at(name).toDouble();
    if (!at(name).isDouble() || number < low || number > high || (whole && number != std::floor(number)))
    {
        refuse(name, QStringLiteral(": not %1 from %2 to %3")
                         .arg(whole ? QStringLiteral("a whole number") : QStringLiteral("a number"))
                         .arg(low, 0, 'g', 16)
                         .arg(high, 0, 'g', 16));
        return std::nullopt;
    }
    return number;
}

} // namespace lampblack
