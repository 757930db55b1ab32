// Lights in the panel: list, numbers, what they are tied to, and sets of them.
#include "support/fake_worker.h"
#include "support/panel_test.h"
#include "tool/panel/light_links.h"
#include "tool/panel/rig_menu.h"
#include "tool/panel/rig_pictures.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QMenu>
#include <QSlider>
#include <QToolButton>

using namespace lampblack;

class PanelLightsTest : public PanelTest
{
    Q_OBJECT

private Q_SLOTS:
    void lightsAreAddedChosenAndDeleted()
    {
        for (int light = 1; light < MaxLights; ++light)
            QTest::mouseClick(find<QToolButton>("light.add"), Qt::LeftButton);
        QCOMPARE(mDocument->scene().lights.size(), MaxLights);
        QVERIFY(!find<QToolButton>("light.add")->isEnabled());
        QCOMPARE(mDocument->selectedLight(), MaxLights - 1);
        QTest::mouseClick(find<QToolButton>("light.2"), Qt::LeftButton);
        QCOMPARE(mDocument->selectedLight(), 1);
        QVERIFY(find<QToolButton>("light.2")->isChecked());
        QVERIFY(!find<QToolButton>("light.4")->isChecked());
        QTest::mouseClick(find<QToolButton>("light.delete"), Qt::LeftButton);
        QCOMPARE(mDocument->scene().lights.size(), MaxLights - 1);
        mDocument->selectLight(-1);
        QVERIFY(!find<QSlider>("power")->isEnabled());
    }

    void eachLightCanBeSwitchedSoloedNamedAndDoubled()
    {
        QTest::mouseClick(find<QToolButton>("light.add"), Qt::LeftButton);
        QTest::mouseClick(find<QToolButton>("light.1.on"), Qt::LeftButton);
        QVERIFY(!light().on);
        QVERIFY(mDocument->scene().lights[1].on);
        QTest::mouseClick(find<QToolButton>("light.2.solo"), Qt::LeftButton);
        QVERIFY(mDocument->scene().lights[1].solo);
        mDocument->undoStack()->undo();
        mDocument->undoStack()->undo();
        QVERIFY(light().on && find<QToolButton>("light.1.on")->isChecked());
        auto* name = find<QLineEdit>("light.1.name");
        QTest::mouseDClick(find<QToolButton>("light.1"), Qt::LeftButton);
        QVERIFY(name->isVisible());
        name->setText(QStringLiteral("Moon"));
        QTest::keyClick(name, Qt::Key_Return);
        QCOMPARE(light().name, QStringLiteral("Moon"));
        QCOMPARE(find<QToolButton>("light.1")->text(), QStringLiteral("Moon"));
        QVERIFY(!name->isVisible());
        mDocument->selectLight(0);
        QTest::mouseClick(find<QToolButton>("light.duplicate"), Qt::LeftButton);
        QCOMPARE(mDocument->scene().lights.size(), 3);
        QCOMPARE(mDocument->selectedLight(), 1);
        QCOMPARE(mDocument->scene().lights[1].power, light().power);
        QVERIFY(mDocument->scene().lights[1].x != light().x);
    }

    void aLightBecomesASunAndHasAPlaceInNumbers()
    {
        QVERIFY(find<QToolButton>("lamp")->isChecked());
        QTest::mouseClick(find<QToolButton>("sun"), Qt::LeftButton);
        QCOMPARE(light().kind, LightKind::Sun);
        find<QDoubleSpinBox>("place.x")->setValue(31);
        QCOMPARE(light().x, 31.0);
        QCOMPARE(light().y, 150.0);
        mDocument->undoStack()->undo();
        QCOMPARE(find<QDoubleSpinBox>("place.x")->value(), 200.0);
    }

    void warmthIsATemperatureInKelvin()
    {
        auto* warmth = find<QDoubleSpinBox>("warmth.field");
        QVERIFY2(qAbs(warmth->value() - 6500) < 400, "white is daylight");
        warmth->setValue(2000);
        const QColor candle = light().colour;
        QVERIFY(candle.red() == 255 && candle.green() < 160 && candle.blue() < 80);
        QVERIFY(qAbs(warmth->value() - 2000) < 30);
        warmth->setValue(12000);
        QVERIFY(light().colour.blue() == 255 && light().colour.red() < 210);
    }

    void aLightCastsShadowsOrFills()
    {
        find<QCheckBox>("light.shadow")->click();
        QVERIFY(!light().castsShadow);
        mDocument->undoStack()->undo();
        QVERIFY(find<QCheckBox>("light.shadow")->isChecked());
    }

    void aLightIsTiedToLayersColoursAndTheDrawing()
    {
        mPanel->findChild<LightLinks*>()->setColours({QStringLiteral("#dd3f2e")});
        const auto choose = [this](const char* button, const QString& entry)
        {
            QMenu* menu = find<QToolButton>(button)->menu();
            Q_EMIT menu->aboutToShow();
            const auto entries = menu->actions();
            for (QAction* action : entries)
                if (action->text() == entry)
                    return action->trigger();
            QFAIL(qPrintable(entry));
        };
        choose("light.layers", QStringLiteral("Line"));
        QCOMPARE(light().layers, QStringList{QStringLiteral("Line")});
        choose("light.colours", QStringLiteral("#dd3f2e"));
        QCOMPARE(light().colours, QStringList{QStringLiteral("#dd3f2e")});
        choose("light.layers", QStringLiteral("All"));
        QVERIFY(light().layers.isEmpty());
        mHost->mFrame = 4;
        auto* pin = find<QToolButton>("light.pin");
        QCOMPARE(pin->text(), QStringLiteral("nothing"));
        choose("light.pin", QStringLiteral("What Is Beneath It Here"));
        QCOMPARE(light().pin->frame, 4);
        QCOMPARE(light().pin->x, light().x);
        QVERIFY(light().pin->layer.isEmpty());
        mDocument->undoStack()->undo();
        QVERIFY(!light().pin);
        choose("light.pin", QStringLiteral("Line"));
        QCOMPARE(light().pin->layer, QStringLiteral("Line"));
        QCOMPARE(pin->text(), QStringLiteral("Line"));
        choose("light.pin", QStringLiteral("Nothing"));
        QVERIFY(!light().pin);
        QTest::mouseClick(find<QToolButton>("sun"), Qt::LeftButton);
        QVERIFY2(!pin->isEnabled(), "only the direction of a sun counts");
    }

    void aSwitchedLightKeepsItsKeys()
    {
        mHost->mFrame = 3;
        QTest::mouseClick(find<QToolButton>("keys.here"), Qt::LeftButton);
        QTest::mouseClick(find<QToolButton>("light.1.on"), Qt::LeftButton);
        QVERIFY(!light().on);
        QCOMPARE(light().keys.size(), 1);
    }

    void setsOfLightsReplaceTheLightsInOneStep()
    {
        const Scene before = mDocument->scene();
        auto* menu = mPanel->findChild<RigMenu*>();
        QCOMPARE(presetRigs().size(), 7);
        const auto entry = [menu](const char* name)
        {
            return menu->findChild<QAction*>(QStringLiteral("lampblack.rigs.") + QLatin1String(name));
        };
        QVERIFY(!entry("three-point")->icon().isNull());
        entry("three-point")->trigger();
        QCOMPARE(mDocument->scene().lights.size(), 3);
        QCOMPARE(mDocument->selectedLight(), 0);
        const Scene lit = mDocument->scene();
        entry("copy")->trigger();
        mDocument->undoStack()->undo();
        QVERIFY(mDocument->scene() == before);
        entry("paste")->trigger();
        QVERIFY2(mDocument->scene().lights == lit.lights, "as on another shot's canvas of the same size");
    }

    void setsAreShownOnTheCurrentDrawing()
    {
        FakeWorker worker;
        auto* menu = mPanel->findChild<RigMenu*>();
        const RigPictures pictures(*mHost, worker, *menu);
        const auto middle = [menu]
        {
            auto* action = menu->findChild<QAction*>(QStringLiteral("lampblack.rigs.moon"));
            const QImage icon = action->icon().pixmap(menu->pictureSide()).toImage();
            return icon.pixelColor(icon.rect().center());
        };
        const QColor ball = middle();
        const auto answer = [&worker](int frame, Qt::GlobalColor colour)
        {
            QImage picture(56, 56, QImage::Format_RGBA8888_Premultiplied);
            picture.fill(colour);
            Q_EMIT worker.rigsArrived(frame, {{QStringLiteral("moon"), picture}});
        };
        Q_EMIT menu->aboutToShow();
        QCOMPARE(worker.mRigs, (QVector<QPair<int, int>>{{1, menu->pictureSide()}}));
        QCOMPARE(middle(), ball);
        answer(2, Qt::blue); // of another frame: later
        QCOMPARE(middle(), ball);
        answer(1, Qt::green);
        QCOMPARE(middle(), QColor(Qt::green));
        mHost->goToFrame(2);
        Q_EMIT menu->aboutToShow();
        QCOMPARE(middle(), QColor(Qt::blue));
        Q_EMIT mHost->drawingChanged(2);
        Q_EMIT menu->aboutToShow();
        QCOMPARE(middle(), ball);
        QCOMPARE(worker.mRigs.size(), 3);
    }
};

QTEST_MAIN(PanelLightsTest)
#include "test_panel_lights.moc"
