// The conformance program of the C++ decoder, for tests/support/conformance.py and
// tests/unit/test_plugin_protocol.py.
//
//   lampblack_conformance CASE...            one line of JSON a case: what the decoder makes of it
//   lampblack_conformance --encode CASE DIR  decode an accepted case, encode it again, write it to DIR
//   lampblack_conformance --mutate VECTORS DIR COUNT SEED  write COUNT mutated messages as cases
//   lampblack_conformance --scene FILE...    one line a scene file: the scene, or {"fault": ...}
//   lampblack_conformance --scene-at FILE FRAME...  one line a frame: the scene there, between its keys
//   lampblack_conformance --copy-scene FROM TO  read a scene file and write it again
//   lampblack_conformance --default-scene WIDTH HEIGHT  the scene that a project starts with
#include "mutator.h"
#include "scene/scene_file.h"
#include "scene/timeline.h"
#include "vectors.h"

#include <QCoreApplication>
#include <QDir>
#include <QJsonDocument>

#include <cstdio>

using namespace lampblack;
using namespace lampblack::protocol;

namespace
{

int print(const QJsonObject& line)
{
    const QByteArray text = QJsonDocument(line).toJson(QJsonDocument::Compact) + '\n';
    return std::fwrite(text.constData(), 1, static_cast<std::size_t>(text.size()), stdout) == 0 ? 1 : 0;
}

int encodeAgain(const QString& from, const QString& to)
{
    Case message = readCase(from);
    const Decoded decoded = decodeCase(message);
    const auto* received = std::get_if<Received>(&decoded);
    const std::optional<QByteArray> header = received != nullptr ? encode(received->message) : std::nullopt;
    if (!header)
    {
        return 1;
    }
    message.frames[0] = *header;
    return writeCase(to, message) ? 0 : 1;
}

int mutate(const QString& vectors, const QString& folder, int count, quint32 seed)
{
    Mutator mutator(vectors, seed);
    for (int i = 0; i < count; ++i)
    {
        if (!writeCase(QDir(folder).filePath(QString::number(i)), mutator.next()))
        {
            return 1;
        }
    }
    return 0;
}

int printScene(const QString& path)
{
    const auto read = readSceneFile(path);
    if (const auto* error = std::get_if<UserError>(&read))
    {
        return print({{QStringLiteral("fault"), error->details}});
    }
    return print(toJson(std::get<Scene>(read)));
}

int printSceneAt(const QString& path, const QStringList& frames)
{
    const auto read = readSceneFile(path);
    const auto* scene = std::get_if<Scene>(&read);
    int failed = scene == nullptr ? 1 : 0;
    for (const QString& frame : scene == nullptr ? QStringList() : frames)
    {
        failed |= print(toJson(sceneAt(*scene, frame.toInt())));
    }
    return failed;
}

} // namespace

int main(int argc, char** argv)
{
    const QCoreApplication application(argc, argv);
    const QStringList arguments = QCoreApplication::arguments().mid(1);
    const QString mode = arguments.value(0);
    if (mode == QLatin1String("--encode"))
    {
        return encodeAgain(arguments.value(1), arguments.value(2));
    }
    if (mode == QLatin1String("--mutate"))
    {
        return mutate(arguments.value(1), arguments.value(2), arguments.value(3).toInt(),
                      arguments.value(4).toUInt());
    }
    if (mode == QLatin1String("--copy-scene"))
    {
        const auto read = readSceneFile(arguments.value(1));
        const auto* scene = std::get_if<Scene>(&read);
        return scene != nullptr && !writeSceneFile(arguments.value(2), *scene) ? 0 : 1;
    }
    if (mode == QLatin1String("--default-scene"))
    {
        return print(toJson(defaultScene({arguments.value(1).toInt(), arguments.value(2).toInt()})));
    }
    if (mode == QLatin1String("--scene-at"))
    {
        return printSceneAt(arguments.value(1), arguments.mid(2));
    }
    const bool scenes = mode == QLatin1String("--scene");
    int failed = 0;
    for (const QString& path : arguments.mid(scenes ? 1 : 0))
    {
        failed |= scenes ? printScene(path) : print(verdict(decodeCase(readCase(path))));
    }
    return failed;
}
