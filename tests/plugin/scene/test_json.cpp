// The scene as JSON: what is read, what is refused, what is kept.
#include "scene/json_text.h"
#include "scene/scene.h"

#include <QJsonArray>
#include <QtTest>

#include <cmath>

using namespace lampblack;

namespace
{

QJsonObject parsed(const QByteArray& text)
{
    const auto result = parseJson(text);
    return std::holds_alternative<QJsonObject>(result) ? std::get<QJsonObject>(result) : QJsonObject();
}

} // namespace

class SceneJson : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void defaultsAreTheWorkers();
    void roundTrip();
    void unknownFieldsAreKeptAtEveryDepth();
    void faultNamesTheField_data();
    void faultNamesTheField();
    void clampedIsReadable();
    void textIsStrict_data();
    void textIsStrict();
    void depth();
};

void SceneJson::defaultsAreTheWorkers()
{
    // Python: default_scene(1280, 720)
    const Scene scene = defaultScene({1280, 720});
    const AreaLight& light = scene.lights.first();
    QCOMPARE(scene.lights.size(), 1);
    QCOMPARE(light.x, 320.0);
    QCOMPARE(light.y, 144.0);
    QCOMPARE(light.z, 640.0);
    QCOMPARE(light.size, 256.0);
    QCOMPARE(light.power, 1.2);
    QCOMPARE(scene.ambient.strength, 0.3);
    QVERIFY(!scene.floor);
    Scene bare;
    bare.canvas = {8, 8};
    const QJsonObject least = parsed(R"({"canvas": {"width": 8, "height": 8}})");
    QVERIFY(sceneFromJson(least) == std::optional<Scene>(bare));
}

void SceneJson::roundTrip()
{
    Scene scene = defaultScene({640, 480});
    scene.lights.append(defaultLight(scene.canvas, -12.25, 1e5));
    scene.lights[1].z = -300;
    scene.lights[1].colour = QColor(255, 1, 16);
    scene.ambient.colour = QColor(0, 0, 1);
    scene.materials.insert(QStringLiteral("#dd3f2e"), {false, true, 0.1, 0.02, {}});
    scene.floor = Floor{411.5, 30};
    scene.reliefScale = 0.7;
    scene.quality = Quality::Medium;
    QVERIFY(sceneFromJson(toJson(scene)) == std::optional<Scene>(scene));
    QVERIFY(sceneFromJson(toShortJson(scene)) == std::optional<Scene>(scene));
    QCOMPARE(toShortJson(scene).value(QLatin1String("materials")).toObject(),
             parsed(R"({"#dd3f2e": {"diffuse": false, "glossy": true, "gloss": 0.1, "roughness": 0.02}})"));
}

void SceneJson::unknownFieldsAreKeptAtEveryDepth()
{
    const QJsonObject tree = parsed(R"({
        "canvas": {"width": 8, "height": 8, "a": 1}, "b": {"deep": [1, {"x": null}]}, "extra": {"mine": 1},
        "lights": [{"x": 1, "y": 2, "z": 3, "c": [true]}], "ambient": {"d": "e"}, "floor": {"y": 1, "f": 9},
        "materials": {"#00ff00": {"sheen": 0.5}}, "default_material": {"coat": {}}})");
    QVERIFY(!tree.isEmpty());
    QJsonObject back = toJson(*sceneFromJson(tree));
    const auto at = [&back](const char* object)
    {
        return back.value(QLatin1String(object)).toObject();
    };
    QCOMPARE(at("canvas").value(QLatin1String("a")), QJsonValue(1));
    QCOMPARE(back.value(QLatin1String("b")), tree.value(QLatin1String("b")));
    QCOMPARE(at("extra").value(QLatin1String("mine")), QJsonValue(1));
    QCOMPARE(back.value(QLatin1String("lights")).toArray().at(0).toObject().value(QLatin1String("c")),
             QJsonValue(QJsonArray{true}));
    QCOMPARE(at("ambient").value(QLatin1String("d")), QJsonValue(QStringLiteral("e")));
    QCOMPARE(at("floor").value(QLatin1String("f")), QJsonValue(9));
    QCOMPARE(at("materials").value(QLatin1String("#00ff00")).toObject().value(QLatin1String("sheen")),
             QJsonValue(0.5));
    QCOMPARE(at("default_material").value(QLatin1String("coat")), QJsonValue(QJsonObject()));
}

void SceneJson::faultNamesTheField_data()
{
    QTest::addColumn<QByteArray>("field");
    QTest::addColumn<QString>("fault");
    const auto row = [](const char* field, const char* fault)
    {
        QTest::newRow(field) << QByteArray(field) << QString::fromLatin1(fault);
    };
    row(R"("lights": [{"x": 1, "y": 2}])", "lights.z: missing");
    row(R"("lights": [{"x": 1, "y": 2, "z": 100001}])", "lights.z: not a number from -100000 to 100000");
    row(R"("lights": [{"x": true, "y": 2, "z": 1}])", "lights.x: ");
    row(R"("lights": [{},{},{},{},{},{},{},{},{}])", "lights: ");
    row(R"("ambient": null)", "ambient: not an object");
    row(R"("ambient": {"colour": "#FFFFFF"})", "ambient.colour: not of the form");
    row(R"("ambient": {"colour": "white"})", "ambient.colour: ");
    row(R"("materials": {"red": {}})", "materials: a key");
    row(R"("materials": {"#ff0000": {"gloss": 1.01}})", "materials.gloss: ");
    row(R"("default_material": {"diffuse": 1})", "default_material.diffuse: ");
    row(R"("floor": {"y": 0, "pitch": 4.9})", "floor.pitch: ");
    row(R"("quality": "best")", "quality: ");
    row(R"("version": 2)", "version: ");
    row(R"("canvas": {"width": 8.5, "height": 8})", "canvas.width: not a whole number");
}

void SceneJson::faultNamesTheField()
{
    QFETCH(QByteArray, field);
    QFETCH(QString, fault);
    QJsonObject tree = parsed(R"({"canvas": {"width": 8, "height": 8}})");
    const QJsonObject wrong = parsed("{" + field + "}");
    QCOMPARE(wrong.size(), 1);
    tree.insert(wrong.begin().key(), wrong.begin().value());
    QString found;
    QVERIFY(!sceneFromJson(tree, &found));
    QVERIFY2(found.startsWith(fault), qPrintable(found));
}

void SceneJson::clampedIsReadable()
{
    Scene wild = defaultScene({100000, 0});
    wild.lights.fill(wild.lights.first(), 9);
    wild.lights[0].x = -1e9;
    wild.lights[1].z = std::nan("");
    wild.lights[2].power = INFINITY;
    wild.lights[3].size = 0;
    wild.lights[3].colours = QStringList{QStringLiteral("red"), QStringLiteral("#00ff00")};
    wild.ambient.colour = QColor::fromHsvF(0.3, 0.5, 0.5, 0.5);
    wild.ambient.strength = -1;
    wild.materials.insert(QStringLiteral("no colour"), Material());
    wild.materials.insert(QStringLiteral("#00ff00"), {true, true, 2, 0, {}});
    wild.floor = Floor{1e6, 90};
    wild.reliefScale = 0;
    const Scene tame = clamped(wild);
    QCOMPARE(tame.lights.size(), MaxLights);
    QCOMPARE(tame.lights[0].x, -1e5);
    QCOMPARE(tame.lights[2].power, 100.0);
    QCOMPARE(tame.lights[3].size, 1.0);
    QCOMPARE(tame.lights[3].colours, QStringList{QStringLiteral("#00ff00")});
    QCOMPARE(sizeOf(tame.canvas), QSize(65536, 1));
    QCOMPARE(tame.materials.keys(), QStringList(QStringLiteral("#00ff00")));
    QCOMPARE(tame.floor->pitch, 85.0);
    QVERIFY(sceneFromJson(toJson(tame)) == std::optional<Scene>(tame));
    QVERIFY(clamped(tame) == tame);
}

void SceneJson::textIsStrict_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<bool>("sound");
    const auto row = [](const char* text, bool sound)
    {
        QTest::newRow(text) << QByteArray(text) << sound;
    };
    row(R"({"a": -0.0e+1, "b": "\u00e9\ud83d\ude00\n"})", true);
    row(R"({"a": .5})", false);
    row(R"({"a": 1.})", false);
    row(R"({"a": 01})", false);
    row(R"({"a": -})", false);
    row(R"({"a": 1e})", false);
    row(R"({"a": truefalse})", false);
    row(R"({"a": "\ud800"})", false);
    row(R"({"a": "\ude00\ud83d"})", false);
    row(R"({"a": "\ud83d\u0041"})", false);
    row(R"({"a": "\u00g0"})", false);
    row(R"({"a": "\u+123"})", false);
    row(R"({"a": "\'"})", false);
    row("{\"a\": \"\t\"}", false);
    row(R"({"a": 9007199254740992})", false);
    row(R"({"a": [{"b": -9007199254740992}]})", false);
    row(R"({"a": 1e-400})", false);
    row(R"([])", false);
    row("", false);
}

void SceneJson::textIsStrict()
{
    QFETCH(QByteArray, text);
    QFETCH(bool, sound);
    QCOMPARE(std::holds_alternative<QJsonObject>(parseJson(text)), sound);
}

void SceneJson::depth()
{
    QCOMPARE(nestingDepth(R"({"[[[": ["\"[[", {}]})"), 3);
    QCOMPARE(nestingDepth("]]]["), 0);
    QCOMPARE(nestingDepth(QByteArray(5000, '[')), 5000);
    QCOMPARE(nestingDepth("\"[[[["), 0);
}

QTEST_GUILESS_MAIN(SceneJson)
#include "test_json.moc"
