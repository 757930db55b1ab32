// Lights and floor between their keys, as the worker has them, and what changing them does to the keys.
#include "scene/json_text.h"
#include "scene/timeline.h"

#include <QDir>
#include <QJsonArray>
#include <QJsonDocument>
#include <QtTest>

using namespace lampblack;

namespace
{

const QString Case = QStringLiteral(LAMPBLACK_VECTORS "/accept/scene-keyed-lights/");

QByteArray contentsOf(const QString& path)
{
    QFile file(path);
    return file.open(QFile::ReadOnly) ? file.readAll() : QByteArray();
}

QJsonObject keyedTree()
{
    const auto header = parseJson(contentsOf(Case + QStringLiteral("header.json")));
    return std::get<QJsonObject>(header).value(QLatin1String("scene")).toObject();
}

/// The same but for the last digits of numbers.
bool isAlike(const QJsonValue& a, const QJsonValue& b)
{
    if (a.isDouble() && b.isDouble())
        return qAbs(a.toDouble() - b.toDouble()) <= 1e-9 * qMax(1.0, qAbs(b.toDouble()));
    if (a.isArray() && b.isArray())
    {
        const QJsonArray first = a.toArray();
        const QJsonArray second = b.toArray();
        return std::equal(first.begin(), first.end(), second.begin(), second.end(), isAlike);
    }
    if (a.isObject() && b.isObject())
    {
        const QJsonObject first = a.toObject();
        const QJsonObject second = b.toObject();
        return first.keys() == second.keys() &&
               std::equal(first.begin(), first.end(), second.begin(), isAlike);
    }
    return a == b;
}

AreaLight keyedLight()
{
    AreaLight light;
    light.keys = {{9, 90, 0, 40, 300, Qt::black, 2, {}}, {1, 10, 0, 0, 100, Qt::white, 1, {}}};
    light.keys[1].extra.insert(QStringLiteral("ease"), QStringLiteral("out"));
    return light;
}

} // namespace

class SceneTimeline : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void isTheWorkersAtEveryFrame();
    void keysGoThroughJsonUnchanged();
    void halfTheLightHalfWay();
    void aChangeMakesOrMovesTheKeyThere();
    void whatIsNotChangedGetsNoKey();
    void aLightWithoutKeysChangesForGood();
    void removingKeysKeepsTheLook();
    void thereIsRoomForSoManyKeys();
    void aFloorHasKeysToo();
};

void SceneTimeline::isTheWorkersAtEveryFrame()
{
    const std::optional<Scene> scene = sceneFromJson(keyedTree());
    QVERIFY(scene);
    const QJsonArray table =
        QJsonDocument::fromJson(contentsOf(Case + QStringLiteral("scene_at.json"))).array();
    QVERIFY(table.size() > 10);
    for (const QJsonValue& row : table)
    {
        const int frame = row[QLatin1String("frame")].toInt();
        const QJsonObject still = toJson(sceneAt(*scene, frame));
        for (const char* part : {"lights", "floor"})
        {
            const QJsonValue found = still.value(QLatin1String(part));
            QVERIFY2(isAlike(found, row[QLatin1String(part)]), qPrintable(QString::number(frame)));
        }
    }
}

void SceneTimeline::keysGoThroughJsonUnchanged()
{
    const QJsonObject tree = keyedTree();
    const QJsonArray before = tree.value(QLatin1String("lights")).toArray();
    const QJsonArray after = toJson(*sceneFromJson(tree)).value(QLatin1String("lights")).toArray();
    const auto keysOf = [](const QJsonValue& light)
    {
        return light[QLatin1String("keys")].toArray();
    };
    QCOMPARE(keysOf(after[0]).size(), 5);
    for (int key = 0; key < 5; ++key)
    {
        const QJsonObject given = keysOf(before[0])[key].toObject();
        for (auto field = given.begin(); field != given.end(); ++field)
            QCOMPARE(keysOf(after[0])[key].toObject().value(field.key()), field.value());
    }
    QVERIFY(!after[2].toObject().contains(QStringLiteral("keys")));
    const std::optional<Scene> scene = sceneFromJson(tree);
    QVERIFY(sceneFromJson(toJson(*scene)) == scene);
}

void SceneTimeline::halfTheLightHalfWay()
{
    const AreaLight light = lightAt(keyedLight(), 5);
    QCOMPARE(light.x, 50.0);
    QCOMPARE(light.size, 200.0);
    QCOMPARE(light.power, 1.5);
    QCOMPARE(light.colour, QColor(188, 188, 188)); // half the light of white, not half its number
    QCOMPARE(lightAt(keyedLight(), 0).x, 10.0);
    QCOMPARE(lightAt(keyedLight(), 100).x, 90.0);
    QVERIFY(light.keys.isEmpty());
}

void SceneTimeline::aChangeMakesOrMovesTheKeyThere()
{
    AreaLight shown = lightAt(keyedLight(), 5);
    shown.y = 33;
    AreaLight changed = changedAt(keyedLight(), 5, shown);
    QCOMPARE(keyFrames(changed), (QVector<int>{1, 5, 9}));
    QCOMPARE(lightAt(changed, 5), shown);
    QCOMPARE(lightAt(changed, 1), lightAt(keyedLight(), 1));
    shown = lightAt(changed, 1);
    shown.power = 7;
    changed = changedAt(changed, 1, shown);
    QCOMPARE(keyFrames(changed), (QVector<int>{1, 5, 9}));
    QCOMPARE(lightAt(changed, 1).power, 7.0);
    QVERIFY(changed.keys[0].extra.contains(QStringLiteral("ease")));
}

void SceneTimeline::whatIsNotChangedGetsNoKey()
{
    for (const int frame : {1, 4, 5, 12})
        QCOMPARE(changedAt(keyedLight(), frame, lightAt(keyedLight(), frame)), keyedLight());
}

void SceneTimeline::aLightWithoutKeysChangesForGood()
{
    AreaLight shown;
    shown.x = 12.3456789;
    QCOMPARE(changedAt(AreaLight(), 5, shown), shown);
}

void SceneTimeline::removingKeysKeepsTheLook()
{
    const AreaLight one = withoutKey(keyedLight(), 1);
    QCOMPARE(keyFrames(one), QVector<int>{9});
    const AreaLight none = withoutKey(one, 9);
    QVERIFY(none.keys.isEmpty());
    QCOMPARE(none, lightAt(keyedLight(), 9));
    QCOMPARE(withoutKey(keyedLight(), 5), keyedLight());
    QCOMPARE(withoutKeys(keyedLight(), 5), lightAt(keyedLight(), 5));
    const AreaLight again = withKey(none, 3);
    QCOMPARE(keyFrames(again), QVector<int>{3});
    QCOMPARE(lightAt(again, 50), none);
}

void SceneTimeline::thereIsRoomForSoManyKeys()
{
    AreaLight light;
    for (int frame = 0; frame < MaxKeys; ++frame)
        light = withKey(light, frame);
    QCOMPARE(light.keys.size(), MaxKeys);
    QCOMPARE(withKey(light, MaxKeys), light);
    AreaLight shown = lightAt(light, 3);
    shown.x = 1;
    QCOMPARE(lightAt(changedAt(light, 3, shown), 3).x, 1.0);
}

void SceneTimeline::aFloorHasKeysToo()
{
    Floor floor;
    floor.y = 100;
    floor = withKey(floor, 2);
    Floor shown = floorAt(floor, 6);
    shown.y = 200;
    shown.pitch = 45;
    floor = changedAt(floor, 6, shown);
    QCOMPARE(floorAt(floor, 4).y, 150.0);
    QCOMPARE(floorAt(floor, 4).pitch, 35.0);
    QCOMPARE(keyFrames(floor), (QVector<int>{2, 6}));
}

QTEST_APPLESS_MAIN(SceneTimeline)
#include "test_timeline.moc"
