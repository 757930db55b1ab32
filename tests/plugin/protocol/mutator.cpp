#include "mutator.h"

#include "protocol/header.h"

#include <QDir>
#include <QJsonArray>
#include <QJsonDocument>

#include <algorithm>
#include <iterator>

namespace lampblack::protocol
{
namespace
{

/// What stands in a header that a parser may trip over.
const QList<QByteArray>& oddTexts()
{
    static const QList<QByteArray> texts =
        QByteArray(R"(null true "" "1" -0 0.0 1e0 1E+2 -1 1.5 .5 1. 01 1e400 1e-400 9007199254740991
9007199254740992 -9007199254740992 99999999999999999999 NaN [] {} [[]] "\ud800" "\ud83d\ude00" "\u0000"
"\x" { } ] [ , : " \ /**/ "type":"bye" "planes":[],)")
            .simplified()
            .split(' ') +
        QList<QByteArray>{"\t",          "\x01", "\"\xff\"", "\"\xed\xa0\x80\"", "\"\xf0\x9f\x98\x80\"",
                          "\xef\xbb\xbf"};
    return texts;
}

/// Values of every type, and those at the edges of fields' ranges.
const QJsonArray& oddValues()
{
    static const QByteArray text = R"([null, true, false, 0, 1, -1, 0.5, 2, 3, 4, 5, 255, 1000, 4096, 4097,
65536, 65537, 999999, 1000000, 2147483647, 2147483648, 9007199254740991, 9007199254740992, 1e-7, 0.01, 1e5,
100001, 1e300, "", "a8", "rgba8", "pixels", "mask", "layer", "low", "lit", "#ff00ff", "#ff00ff\n", "1-20x2,25",
"9-1", "0-999999", "/a%04d.png", "\u0000", "\ud83d\ude00", [], {}, [1, 0, 0, 0, 1, 0], [1, 2, 3, 2, 4, 6],
[{}], {"x": 1, "y": 1, "z": 1, "width": 1, "height": 1}])";
    static const QJsonArray values = QJsonDocument::fromJson(text).array();
    return values;
}

} // namespace

Mutator::Mutator(const QString& vectors, quint32 seed) : mRandom(seed)
{
    const QDir dir(vectors);
    mSound = readCases(dir.filePath(QStringLiteral("accept")));
    mAll = mSound;
    std::copy_if(mSound.begin(), mSound.end(), std::back_inserter(mWithPlanes),
                 [](const Case& message) { return message.frames.size() > 1; });
    const QVector<Case> refused = readCases(dir.filePath(QStringLiteral("reject")));
    for (const Case& message : refused)
    {
        if (!message.expected.contains(QLatin1String("limits")) && !message.frames.isEmpty())
        {
            mAll.append(message);
        }
    }
}

int Mutator::below(int bound)
{
    // Not uniform_int_distribution, which each standard library does in its own way.
    return static_cast<int>(mRandom() % static_cast<quint32>(qMax(1, bound)));
}

Case Mutator::next()
{
    const int kind = below(100);
    const QVector<Case>& pool = kind >= 75 ? mWithPlanes : chance(85) ? mSound : mAll;
    Case message = pool[below(pool.size())];
    if (kind < 25)
    {
        changeBytes(message.frames[0]);
    }
    else if (kind < 75)
    {
        changeTree(message);
    }
    else
    {
        changePlanes(message);
    }
    if (chance(3))
    {
        message.sender = message.sender == Sender::Client ? Sender::Worker : Sender::Client;
    }
    return message;
}

void Mutator::changeBytes(QByteArray& bytes)
{
    for (int times = 1 + below(3); times > 0; --times)
    {
        // The first 15 bytes are mostly spared: beyond them is more to find.
        const int from = chance(5) ? 0 : qMin(15, bytes.size());
        const int at = from + below(bytes.size() - from + 1);
        const QByteArray odd = oddTexts().at(below(oddTexts().size()));
        switch (below(7))
        {
        case 0:
            bytes.insert(at, odd);
            break;
        case 1:
            bytes.replace(at, 1 + below(4), odd);
            break;
        case 2:
            bytes.remove(at, 1 + below(8));
            break;
        case 3:
            bytes.insert(at, bytes.mid(from + below(bytes.size() - from + 1), below(40)));
            break;
        case 4:
            bytes.truncate(at);
            break;
        case 5:
            bytes.insert(at, QByteArray(1 + below(40), chance(50) ? '[' : '{'));
            break;
        default:
            if (at < bytes.size())
            {
                bytes[at] = static_cast<char>(bytes.at(at) ^ (1 << below(8)));
            }
        }
    }
}

QJsonValue Mutator::oddValue()
{
    // Longer than names and sentences may be, in characters of two UTF-16 units each.
    const QString sentence = QStringLiteral("\U0001f600").repeated(chance(50) ? 65 : 501);
    return chance(5) ? QJsonValue(sentence) : oddValues().at(below(oddValues().size()));
}

QJsonObject Mutator::changedObject(QJsonObject object)
{
    QStringList keys = object.keys();
    if (chance(95))
    {
        keys.removeOne(QStringLiteral("type")); // else most mutants would be of no type
    }
    const QString key = keys.value(below(keys.size()));
    const int kind = below(100);
    if (keys.isEmpty() || kind < 8)
    {
        object.insert(chance(50) ? QStringLiteral("unknown") : QStringLiteral("planes"), oddValue());
    }
    else if (kind < 18)
    {
        object.remove(key);
    }
    else
    {
        object.insert(key, changedValue(object.value(key)));
    }
    return object;
}

QJsonValue Mutator::changedValue(const QJsonValue& value)
{
    if (value.isObject() && !chance(10))
    {
        return changedObject(value.toObject());
    }
    if (value.isArray() && !value.toArray().isEmpty() && !chance(10))
    {
        QJsonArray array = value.toArray();
        const int at = below(array.size());
        if (chance(20))
        {
            array.append(array.at(at));
        }
        else if (chance(20))
        {
            array.removeAt(at);
        }
        else
        {
            array[at] = changedValue(array.at(at));
        }
        return array;
    }
    if (value.isDouble() && !chance(30))
    {
        static const QVector<double> factors = {0, -1, 0.5, 2, 10, 1e3, 1e6};
        const double number = value.toDouble();
        return chance(50) ? number * factors[below(factors.size())] : number + below(3) - 1;
    }
    if (value.isString() && !chance(30))
    {
        QString text = value.toString();
        const QChar odd(static_cast<ushort>(chance(50) ? 32 + below(95) : below(0xd800)));
        return chance(50) ? text.insert(below(text.size() + 1), odd) : text.left(below(text.size() + 1));
    }
    return oddValue();
}

void Mutator::changeTree(Case& message)
{
    QJsonObject tree = QJsonDocument::fromJson(message.frames[0]).object();
    tree.remove(QStringLiteral("lampblack"));
    for (int times = chance(70) ? 1 : 2; times > 0; --times)
    {
        tree = changedObject(tree);
    }
    message.frames[0] = QJsonDocument(tree).toJson(QJsonDocument::Compact).replace(0, 1, headerBeginning());
    if (chance(50))
    {
        repairPlanes(message);
    }
}

void Mutator::changePlanes(Case& message)
{
    QVector<QByteArray>& frames = message.frames;
    const int at = 1 + below(frames.size() - 1);
    if (chance(10))
    {
        frames.append(QByteArray(below(64), 'x'));
    }
    else if (chance(10))
    {
        frames.removeAt(at);
    }
    else if (chance(10))
    {
        frames.swapItemsAt(at, frames.size() - 1);
    }
    else if (chance(30))
    {
        frames[at].resize(below(2 * frames[at].size() + 2));
        frames[at].fill(static_cast<char>(below(256)));
    }
    else
    {
        changeTree(message);
    }
    if (chance(60))
    {
        repairPlanes(message);
    }
}

/// Make payloads as long as the header says, where that is little, and give put_frame their digest: then
/// the mutant is judged by what comes after.
void Mutator::repairPlanes(Case& message)
{
    constexpr double Most = 1 << 16;
    QJsonObject tree = QJsonDocument::fromJson(message.frames[0]).object();
    const QJsonArray planes = tree.value(QLatin1String("planes")).toArray();
    QVector<PlaneView> views;
    for (int i = 0; i < planes.size() && i + 1 < message.frames.size(); ++i)
    {
        const QJsonObject plane = planes.at(i).toObject();
        const double width = plane.value(QLatin1String("width")).toDouble();
        const double height = plane.value(QLatin1String("height")).toDouble();
        const double stride = plane.value(QLatin1String("stride")).toDouble();
        const QString roleName = plane.value(QLatin1String("role")).toString();
        if (!(stride >= 1 && height >= 1 && width >= 1 && stride * height <= Most && width <= stride))
        {
            return;
        }
        const int size = static_cast<int>(stride) * static_cast<int>(height);
        QByteArray& payload = message.frames[i + 1];
        payload = payload.leftJustified(size, 'p', true);
        const Role role = roleName == QLatin1String("pixels")  ? Role::Pixels
                          : roleName == QLatin1String("mask")  ? Role::Mask
                          : roleName == QLatin1String("layer") ? Role::Layer
                                                               : Role::Ink;
        const Format format = formatOf(role);
        if (width * bytesPerPixel(format) > stride)
        {
            return;
        }
        views.append(
            {{role, format, static_cast<int>(width), static_cast<int>(height), static_cast<int>(stride)},
             reinterpret_cast<const uchar*>(payload.constData())});
    }
    if (tree.value(QLatin1String("type")) == QLatin1String("put_frame") && !views.isEmpty())
    {
        tree.remove(QStringLiteral("lampblack"));
        QStringList layers;
        for (const QJsonValue layer : tree.value(QLatin1String("layers")).toArray())
        {
            layers.append(layer.toString());
        }
        tree.insert(QStringLiteral("digest"), QString::fromLatin1(frameDigest(views, layers)));
        message.frames[0] =
            QJsonDocument(tree).toJson(QJsonDocument::Compact).replace(0, 1, headerBeginning());
    }
}

} // namespace lampblack::protocol
