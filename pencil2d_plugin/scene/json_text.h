// JSON as both languages of Lampblack agree on it (protocol/SPEC.md 3.1): stricter than Qt's parser.
#pragma once

#include <QByteArray>
#include <QJsonObject>
#include <QString>

#include <variant>

namespace lampblack
{

/// Numbers are at most this in magnitude: 2^53 - 1, beyond which doubles skip integers.
constexpr double MaxNumber = 9007199254740991.0;

struct JsonFault
{
    enum class Kind
    {
        Text,  ///< not strict JSON, or no object
        Number ///< a number beyond MaxNumber, or too near zero for a double
    };
    Kind kind = Kind::Text;
    QString details;
};

/// The deepest that brackets outside strings nest, whether or not the text is sound.
qint64 nestingDepth(const QByteArray& text);

/// Parse one object. The caller bounds the text's size and depth first. Of keys that come twice the last
/// counts (an object or array that is thus dropped leaks in Qt 5.15, as a leak sanitizer will say).
std::variant<QJsonObject, JsonFault> parseJson(const QByteArray& text);

} // namespace lampblack
