#include "protocol/header.h"
#include "protocol/message_fields.h"
#include "scene/json_writer.h"

#include <algorithm>
#include <utility>

namespace lampblack::protocol
{
namespace
{

struct Type
{
    const char* name;
    bool fromClient;
    bool fromWorker;
};

/// In the order of Message's alternatives.
constexpr std::array<Type, std::variant_size_v<Message>> Types = {{{"hello", true, false},
                                                                   {"put_frame", true, false},
                                                                   {"drop_frame", true, false},
                                                                   {"set_scene", true, false},
                                                                   {"preview", true, false},
                                                                   {"view", true, false},
                                                                   {"get_palette", true, false},
                                                                   {"render", true, false},
                                                                   {"cancel", true, false},
                                                                   {"welcome", false, true},
                                                                   {"need_frame", false, true},
                                                                   {"image", false, true},
                                                                   {"palette", false, true},
                                                                   {"progress", false, true},
                                                                   {"frame_done", false, true},
                                                                   {"done", false, true},
                                                                   {"status", false, true},
                                                                   {"error", false, true},
                                                                   {"bye", true, true}}};

template <std::size_t... Index> Message blank(std::size_t type, std::index_sequence<Index...> /*all*/)
{
    using Make = Message (*)();
    static constexpr std::array<Make, sizeof...(Index)> Makers = {
        []
        {
            return Message(std::in_place_index<Index>);
        }...};
    return Makers.at(type)();
}

class MessageReader : public JsonReader
{
public:
    using JsonReader::JsonReader;

    ErrorCode code() const { return mCode; }

    void scene(const char* name, Scene& scene)
    {
        if (!wanted(name, Need::Required))
        {
            return;
        }
        QString why = QStringLiteral("not an object");
        const std::optional<Scene> read =
            at(name).isObject() ? sceneFromJson(at(name).toObject(), &why) : std::nullopt;
        if (!read)
        {
            mCode = fault().isEmpty() ? ErrorCode::BadScene : mCode;
            refuse(name, QLatin1Char('.') + why);
            return;
        }
        scene = *read;
    }

private:
    ErrorCode mCode = ErrorCode::BadField;
};

class MessageWriter : public JsonWriter
{
public:
    void scene(const char* name, const Scene& scene) { put(name, toJson(scene)); }
};

} // namespace

const Patterns& patterns()
{
    static const Patterns all;
    return all;
}

QString typeOf(const Message& message)
{
    return QLatin1String(Types.at(message.index()).name);
}

std::variant<Message, HeaderFault> readMessage(const QJsonObject& tree, Sender sender)
{
    const QJsonValue name = tree.value(QLatin1String("type"));
    const auto* type =
        std::find_if(Types.begin(), Types.end(),
                     [&name](const Type& known)
                     { return name.isString() && name.toString() == QLatin1String(known.name); });
    if (type == Types.end())
    {
        return HeaderFault{ErrorCode::UnknownType, name.toString().left(40)};
    }
    if (!(sender == Sender::Client ? type->fromClient : type->fromWorker))
    {
        return HeaderFault{ErrorCode::WrongDirection, QLatin1String(type->name)};
    }
    Message message = blank(static_cast<std::size_t>(type - Types.begin()),
                            std::make_index_sequence<std::variant_size_v<Message>>());
    MessageReader reader(tree);
    std::visit([&reader](auto& alternative) { describe(reader, alternative); }, message);
    if (!reader.fault().isEmpty())
    {
        return HeaderFault{reader.code(), reader.fault()};
    }
    return message;
}

QJsonObject messageTree(const Message& message)
{
    MessageWriter writer;
    Message copy = message;
    std::visit([&writer](auto& alternative) { describe(writer, alternative); }, copy);
    QJsonObject tree = writer.tree();
    tree.insert(QLatin1String("type"), typeOf(message));
    return tree;
}

QJsonObject wireTree(const Message& message)
{
    QJsonObject tree = messageTree(message);
    if (const auto* set = std::get_if<SetScene>(&message))
    {
        tree.insert(QLatin1String("scene"), toShortJson(set->scene));
    }
    return tree;
}

} // namespace lampblack::protocol
