// Rigs: lights to use again, on canvases of other sizes.
#include "scene/rig_file.h"
#include "scene/rig_place.h"

#include <QTemporaryDir>
#include <QtTest>

using namespace lampblack;

class RigTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aRigFitsTheLongerSideOfTheCanvas()
    {
        Scene small = defaultScene(QSize(400, 300));
        small.lights[0].x = 100;
        small.lights[0].y = 150;
        small.lights[0].z = 80;
        small.lights[0].size = 20;
        small.lights[0].power = 1.5;
        const Scene large = withRig(defaultScene(QSize(600, 800)), rigOf(small, QStringLiteral("Mine")));
        const AreaLight& light = large.lights[0];
        QCOMPARE(light.x, 100.0); // the middle less 100, twice as far
        QCOMPARE(light.y, 400.0);
        QCOMPARE(light.z, 160.0);
        QCOMPARE(light.size, 40.0);
        QCOMPARE(light.power, 1.5);
    }

    void aLampOnASmallFigureIsNearerAndDimmer()
    {
        Scene scene = defaultScene(QSize(400, 400));
        scene.lights[0] = defaultLight(scene.canvas, 200, 200);
        scene.lights[0].power = 1;
        const Rig rig = rigOf(scene, QString());
        const double radius = scene.lights[0].size / 2 / 200;
        const AreaLight lamp = withRig(scene, rig, QRectF(100, 40, 200, 100)).lights[0];
        QCOMPARE(QPointF(lamp.x, lamp.y), QPointF(200, 90));
        QCOMPARE(lamp.z, 100.0);
        QCOMPARE(lamp.power, 0.25 * (1 + radius * radius) / (1 + radius * radius / 4));
        scene.lights[0].kind = LightKind::Sun;
        const AreaLight sun = withRig(scene, rigOf(scene, QString()), QRectF(100, 40, 200, 100)).lights[0];
        QCOMPARE(QPointF(sun.x, sun.y), QPointF(200, 200));
        QCOMPARE(sun.power, 1.0);
    }

    void aRigOnItsOwnCanvasChangesNothing()
    {
        const Scene scene = defaultScene(QSize(640, 720));
        QVERIFY(withRig(scene, rigOf(scene, QString())) == scene);
    }

    void aFileBringsBackTheRig()
    {
        const QTemporaryDir folder;
        const QString path = folder.filePath(QStringLiteral("mine.rig.json"));
        Scene scene = defaultScene(QSize(640, 720));
        scene.lights[0].name = QStringLiteral("Moon");
        const Rig rig = rigOf(scene, QStringLiteral("Night"));
        QVERIFY(!writeRigFile(path, rig));
        const auto read = readRigFile(path);
        QVERIFY(std::get<Rig>(read) == rig);
    }

    void whatIsNoRigIsRefusedInWords()
    {
        for (const char* text : {"", "[]", "{\"lights\": 3}", "{\"canvas\": {\"width\": -1, \"height\": 2}}"})
        {
            const auto read = rigFromText(text, QStringLiteral("some.json"));
            const auto* error = std::get_if<UserError>(&read);
            QVERIFY2(error != nullptr && error->what.contains(QLatin1String("some.json")), text);
        }
        QVERIFY(std::holds_alternative<UserError>(readRigFile(QStringLiteral("/nowhere.json"))));
    }
};

QTEST_APPLESS_MAIN(RigTest)
#include "test_rig.moc"
