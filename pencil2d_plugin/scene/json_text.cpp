#include "scene/json_text.h"

#include <QJsonArray>
#include <QJsonDocument>

#include <cmath>
#include <cstring>
#include <optional>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace lampblack
{
namespace
{

bool isDigit(char c)
{
    return c >= '0' && c <= '9';
}

bool isHex(char c)
{
    return isDigit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

/// Walks over the bytes of a text, token by token: what Qt's parser lets pass is refused here, what Qt
/// refuses (order of tokens, UTF-8) is left to it. The functions return false at the first bad byte.
class TokenWalk
{
public:
    explicit TokenWalk(const QByteArray& text) : mAt(text.constBegin()), mEnd(text.constEnd()) {}

    bool all()
    {
        while (mAt != mEnd)
        {
            if (!one())
            {
                return false;
            }
        }
        return true;
    }

private:
    bool one()
    {
        switch (*mAt)
        {
        case ' ':
        case '\t':
        case '\n':
        case '\r':
        case '{':
        case '}':
        case '[':
        case ']':
        case ':':
        case ',':
            ++mAt;
            return true;
        case '"':
            ++mAt;
            return string();
        case 't':
            return word("true");
        case 'f':
            return word("false");
        case 'n':
            return word("null");
        default:
            return number();
        }
    }

    bool next(char c)
    {
        const bool there = mAt != mEnd && *mAt == c;
        mAt += there ? 1 : 0;
        return there;
    }

    bool nextOf(const char* characters)
    {
        const bool there = mAt != mEnd && *mAt != '\0' && std::strchr(characters, *mAt) != nullptr;
        mAt += there ? 1 : 0;
        return there;
    }

    bool word(const char* letters)
    {
        for (; *letters != '\0'; ++letters)
        {
            if (!next(*letters))
            {
                return false;
            }
        }
        return true;
    }

    bool digits()
    {
        const char* first = mAt;
        while (mAt != mEnd && isDigit(*mAt))
        {
            ++mAt;
        }
        return mAt != first;
    }

    bool number()
    {
        next('-');
        if (!next('0') && !digits())
        {
            return false;
        }
        if (next('.') && !digits())
        {
            return false;
        }
        if (nextOf("eE"))
        {
            nextOf("+-");
            if (!digits())
            {
                return false;
            }
        }
        return !nextOf("0123456789.eE+-");
    }

    bool string()
    {
        while (mAt != mEnd)
        {
            const char c = *mAt++;
            if (c == '"')
            {
                return true;
            }
            if (static_cast<unsigned char>(c) < 0x20 || (c == '\\' && !escape()))
            {
                return false;
            }
        }
        return false;
    }

    bool escape()
    {
        if (nextOf("\"\\/bfnrt"))
        {
            return true;
        }
        const std::optional<uint> first = codeUnit();
        if (!first || QChar::isLowSurrogate(*first))
        {
            return false;
        }
        if (!QChar::isHighSurrogate(*first))
        {
            return true;
        }
        const std::optional<uint> second = next('\\') ? codeUnit() : std::nullopt;
        return second && QChar::isLowSurrogate(*second);
    }

    std::optional<uint> codeUnit()
    {
        if (!next('u') || mEnd - mAt < 4)
        {
            return std::nullopt;
        }
        const QByteArray hex(mAt, 4);
        mAt += 4;
        bool valid = std::all_of(hex.begin(), hex.end(), isHex);
        const uint unit = hex.toUInt(&valid, 16);
        return valid ? std::optional<uint>(unit) : std::nullopt;
    }

    const char* mAt;
    const char* mEnd;
};

bool numbersAreHeld(const QJsonValue& value)
{
    if (value.isArray())
    {
        const QJsonArray array = value.toArray();
        return std::all_of(array.begin(), array.end(), numbersAreHeld);
    }
    if (value.isObject())
    {
        const QJsonObject object = value.toObject();
        return std::all_of(object.begin(), object.end(), numbersAreHeld);
    }
    return !value.isDouble() || std::abs(value.toDouble()) <= MaxNumber;
}

QJsonDocument readJson(const QByteArray& text, QJsonParseError* error)
{
#ifdef __SANITIZE_ADDRESS__
    const __lsan::ScopedDisabler unwatched; // Qt 5.15 leaks a container on some malformed texts
#endif
    return QJsonDocument::fromJson(text, error);
}

} // namespace

qint64 nestingDepth(const QByteArray& text)
{
    qint64 level = 0;
    qint64 deepest = 0;
    bool inString = false;
    for (int i = 0; i < text.size(); ++i)
    {
        const char c = text[i];
        if (c == '"')
        {
            inString = !inString;
        }
        else if (inString)
        {
            i += c == '\\' ? 1 : 0;
        }
        else if (c == '{' || c == '[')
        {
            deepest = qMax(deepest, ++level);
        }
        else if (c == '}' || c == ']')
        {
            --level;
        }
    }
    return deepest;
}

std::variant<QJsonObject, JsonFault> parseJson(const QByteArray& text)
{
    if (!TokenWalk(text).all())
    {
        return JsonFault{JsonFault::Kind::Text, QStringLiteral("a byte that JSON does not allow there")};
    }
    QJsonParseError error;
    const QJsonDocument document = readJson(text, &error);
    if (error.error == QJsonParseError::IllegalNumber)
    {
        return JsonFault{JsonFault::Kind::Number, QStringLiteral("at byte %1").arg(error.offset)};
    }
    if (error.error != QJsonParseError::NoError || !document.isObject())
    {
        return JsonFault{JsonFault::Kind::Text,
                         QStringLiteral("%1 at byte %2").arg(error.errorString()).arg(error.offset)};
    }
    if (!numbersAreHeld(document.object()))
    {
        return JsonFault{JsonFault::Kind::Number, QStringLiteral("a number beyond 2^53 - 1")};
    }
    return document.object();
}

} // namespace lampblack
