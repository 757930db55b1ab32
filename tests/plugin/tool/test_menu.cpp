// The menu under the right button, and the colour that it is about.
#include "support/fake_host.h"
#include "support/scenes.h"
#include "tool/canvas/frame_colours.h"
#include "tool/canvas/lamp_menu.h"

#include <QPainter>

using namespace lampblack;

namespace
{

const QString Red = QStringLiteral("#dd3f2e");

QAction* entry(const LampMenu& menu, const char* name)
{
    return menu.findChild<QAction*>(QStringLiteral("lampblack.menu.") + QLatin1String(name));
}

} // namespace

class MenuTest : public QObject
{
    Q_OBJECT

private:
    FakeHost mHost;
    SceneDocument mDocument;
    LampMenu mMenu{mHost, mDocument, nullptr};

    void choose(const char* name, const QString& colour = QString(), const Handle& handle = {})
    {
        mMenu.openAt({120, 80}, QPoint(), handle, colour);
        QAction* action = entry(mMenu, name);
        QVERIFY2(action != nullptr, name);
        action->trigger();
        mMenu.close();
    }

private Q_SLOTS:
    void init() { mDocument.reset(sceneWithLight(200, 150, 200)); }

    void addsALightHereAndSelectsIt()
    {
        choose("add_light");
        QCOMPARE(mDocument.scene().lights.size(), 2);
        QCOMPARE(mDocument.scene().lights[1].x, 120.0);
        QCOMPARE(mDocument.scene().lights[1].y, 80.0);
        QCOMPARE(mDocument.selectedLight(), 1);
    }

    void offersNoFifthLight()
    {
        for (int light = 1; light < MaxLights; ++light)
            choose("add_light");
        mMenu.openAt({}, QPoint(), {}, QString());
        QVERIFY(!entry(mMenu, "add_light")->isEnabled());
        mMenu.close();
    }

    void deletesTheLightThatItWasOpenedOn()
    {
        choose("add_light");
        const AreaLight second = mDocument.scene().lights[1];
        choose("delete_light", QString(), {HandlePart::Light, 0});
        QCOMPARE(mDocument.scene().lights, QVector<AreaLight>{second});
        mMenu.openAt({}, QPoint(), {}, QString());
        QVERIFY(entry(mMenu, "delete_light") == nullptr);
        mMenu.close();
    }

    void placesMovesAndRemovesTheFloor()
    {
        choose("floor");
        QCOMPARE(mDocument.scene().floor->y, 80.0);
        Scene scene = mDocument.scene();
        scene.floor->pitch = 60;
        scene.floor->y = 10;
        mDocument.edit(QString(), scene);
        choose("floor");
        QCOMPARE(mDocument.scene().floor->y, 80.0);
        QCOMPARE(mDocument.scene().floor->pitch, 60.0);
        choose("remove_floor");
        QVERIFY(!mDocument.scene().floor);
        QCOMPARE(mDocument.undoStack()->count(), 4);
    }

    void changesTheMaterialUnderThePointer()
    {
        choose("glossy", Red);
        QVERIFY(materialOf(mDocument.scene(), Red).glossy);
        QVERIFY(materialOf(mDocument.scene(), Red).diffuse);
        choose("diffuse", Red);
        QVERIFY(!materialOf(mDocument.scene(), Red).diffuse);
        choose("diffuse", Red);
        choose("glossy", Red);
        QVERIFY2(mDocument.scene().materials.isEmpty(), "a default material need not be listed");
    }

    void resetsTheLightButNotTheMaterials()
    {
        choose("glossy", Red);
        choose("floor");
        choose("add_light");
        choose("reset");
        QCOMPARE(mDocument.scene().lights, defaultScene(QSize(400, 300)).lights);
        QVERIFY(!mDocument.scene().floor);
        QVERIFY(materialOf(mDocument.scene(), Red).glossy);
        mDocument.undoStack()->undo();
        QCOMPARE(mDocument.scene().lights.size(), 2);
    }

    void readsTheColourUnderThePointer()
    {
        FrameExport frame;
        frame.image = QImage(40, 40, QImage::Format_RGBA8888);
        frame.image.fill(Qt::transparent);
        QPainter painter(&frame.image);
        painter.fillRect(10, 10, 20, 20, QColor(0xdd, 0x3f, 0x2e));
        painter.fillRect(10, 10, 2, 20, Qt::black); // ink
        painter.end();
        frame.canvasToImage = QTransform::fromTranslate(5, 0);
        FrameColours colours;
        colours.setFrame(frame);
        QCOMPARE(colours.at({15, 20}), QColor(0xdd, 0x3f, 0x2e).name());
        colours.setSwatches({{QStringLiteral("#e04030"), 300}, {QStringLiteral("#101010"), 9}});
        QCOMPARE(colours.at({15, 20}), QStringLiteral("#e04030"));
        QCOMPARE(colours.at({1, 20}), QString());
        QCOMPARE(colours.at({1000, -20}), QString());
        // On a line the nearest fill is meant, unless the ink is itself a swatch.
        colours.setSwatches({{QStringLiteral("#dd3f2e"), 300}, {QStringLiteral("#f5d6bb"), 9}});
        QCOMPARE(colours.at({6, 20}), QStringLiteral("#dd3f2e"));
    }
};

QTEST_MAIN(MenuTest)
#include "test_menu.moc"
