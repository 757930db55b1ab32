// Scene and rig files that were sound once. Build with LAMPBLACK_SANITIZE for this to see what it may.
#include "scene/rig_file.h"
#include "scene/rig_place.h"
#include "scene/scene_file.h"

#include <QFile>
#include <QTemporaryDir>
#include <QtTest>

#include <random>

// Of keys that come twice in JSON, Qt 5.15 leaks the first one's object or array.
extern "C" __attribute__((visibility("default"))) const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions()
{
    return "leak:libQt5Core.so";
}

using namespace lampblack;

namespace
{

constexpr int Count = 1500;

const QByteArray Words[] = {
    "",       "-1", "1e999",       "NaN",  "99999999999999999999", "\"",   "\\", "null", "true",
    "[]",     "{}", "\"\\ud800\"", "\xff", "../../etc/passwd",     "1e-9", "0",  "#zzz", "[[[[[",
    "{\"a\":"};

class Spoiler
{
public:
    explicit Spoiler(quint32 seed) : mRandom(seed) {}

    QByteArray spoiled(QByteArray text)
    {
        for (int times = 1 + below(3); times > 0 && !text.isEmpty(); --times)
        {
            const int place = below(text.size());
            switch (below(5))
            {
            case 0:
                text[place] = static_cast<char>(below(256));
                break;
            case 1:
                text.insert(place, Words[static_cast<std::size_t>(below(std::size(Words)))]);
                break;
            case 2:
                text.remove(place, 1 + below(30));
                break;
            case 3:
                text.insert(place, text.mid(place, 1 + below(200)));
                break;
            default:
                spoilValue(text, place);
            }
        }
        return text;
    }

private:
    int below(std::size_t bound) { return static_cast<int>(mRandom() % static_cast<quint32>(bound)); }

    /// Replace the value of the next key: the text stays sound JSON.
    void spoilValue(QByteArray& text, int from)
    {
        const int begin = text.indexOf(": ", from) + 2;
        const int end = text.indexOf('\n', begin);
        if (begin > 2 && end > begin && text[begin] != '{' && text[begin] != '[')
        {
            const bool more = text[end - 1] == ',';
            text.replace(begin, end - begin,
                         Words[static_cast<std::size_t>(below(std::size(Words)))] + (more ? "," : ""));
        }
    }

    std::mt19937 mRandom;
};

QByteArray contents(const QString& path)
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

void write(const QString& path, const QByteArray& text)
{
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
}

} // namespace

class SpoiledTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aSceneIsReadOrRefused()
    {
        const QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("scene.json"));
        Scene scene = defaultScene({640, 480});
        scene.floor = Floor{};
        scene.lights[0].keys = {LightKey{}, LightKey{}};
        scene.lights[0].keys[1].frame = 9;
        QVERIFY(!writeSceneFile(path, scene));
        const QByteArray sound = contents(path);
        Spoiler spoiler(7);
        int read = 0;
        for (int index = 0; index < Count; ++index)
        {
            write(path, spoiler.spoiled(sound));
            const auto found = readSceneFile(path);
            if (const auto* error = std::get_if<UserError>(&found))
            {
                QVERIFY(!error->what.isEmpty());
                continue;
            }
            // What is read can be written and read again: no value is out of bounds.
            ++read;
            QVERIFY(!writeSceneFile(path, std::get<Scene>(found)));
            const auto again = readSceneFile(path);
            QVERIFY(std::holds_alternative<Scene>(again));
            QVERIFY(std::get<Scene>(again) == std::get<Scene>(found));
        }
        QVERIFY2(read > Count / 50 && read < Count, qPrintable(QString::number(read)));
    }

    void aRigIsReadOrRefused()
    {
        const QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("rig.json"));
        QVERIFY(!writeRigFile(path, rigOf(defaultScene({640, 480}), QStringLiteral("Moon"))));
        const QByteArray sound = contents(path);
        Spoiler spoiler(8);
        int read = 0;
        for (int index = 0; index < Count; ++index)
        {
            write(path, spoiler.spoiled(sound));
            read += std::holds_alternative<Rig>(readRigFile(path));
        }
        QVERIFY2(read > Count / 50 && read < Count, qPrintable(QString::number(read)));
    }
};

QTEST_APPLESS_MAIN(SpoiledTest)
#include "test_spoiled.moc"
