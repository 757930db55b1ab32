#include "protocol/generated/message_fields.h"
#include "protocol/header.h"
#include "scene/json_writer.h"
#include "scene/scene.h"

#include <algorithm>
#include <utility>

namespace lampblack::protocol
{
namespace
{

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
    using JsonReader::object;

    /// A scene has a code of its own, which counts before that of any other field (SPEC 3.4).
    void object(const char* name, Scene& scene)
    {
        if (!wanted(name, Need::Required))
        {
            return;
        }
        QString why = QStringLiteral("not an object");
        const std::optional<Scene> read =
            at(name).isObject() ? sceneFromJson(at(name).toObject(), &why) : std::nullopt;
        if (read)
        {
            scene = *read;
            return;
        }
        mSceneFault = HeaderFault{ErrorCode::BadScene, QLatin1String(name) + QLatin1Char('.') + why};
    }

    std::optional<HeaderFault> headerFault() const
    {
        const HeaderFault field = {ErrorCode::BadField, fault()};
        return mSceneFault || fault().isEmpty() ? mSceneFault : field;
    }

private:
    std::optional<HeaderFault> mSceneFault;
};

class MessageWriter : public JsonWriter
{
public:
    using JsonWriter::object;

    void object(const char* name, Scene& scene) { put(name, toJson(scene)); }
};

} // namespace

QString typeOf(const Message& message)
{
    return QLatin1String(MessageTypes.at(message.index()).name);
}

std::variant<Message, HeaderFault> readMessage(const QJsonObject& tree, Sender sender)
{
    const QJsonValue name = tree.value(QLatin1String("type"));
    const auto* type =
        std::find_if(MessageTypes.begin(), MessageTypes.end(),
                     [&name](const MessageType& known)
                     { return name.isString() && name.toString() == QLatin1String(known.name); });
    if (type == MessageTypes.end())
    {
        return HeaderFault{ErrorCode::UnknownType, name.toString().left(40)};
    }
    if (!(sender == Sender::Client ? type->fromClient : type->fromWorker))
    {
        return HeaderFault{ErrorCode::WrongDirection, QLatin1String(type->name)};
    }
    Message message = blank(static_cast<std::size_t>(type - MessageTypes.begin()),
                            std::make_index_sequence<std::variant_size_v<Message>>());
    MessageReader reader(tree);
    std::visit([&reader](auto& alternative) { describe(reader, alternative); }, message);
    if (const std::optional<HeaderFault> fault = reader.headerFault())
    {
        return *fault;
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
