// Keyed lights and floors: seen where they are at the frame, changed by a key there, one step a drag.
#include "scene/timeline.h"
#include "support/fake_host.h"
#include "support/mouse.h"
#include "support/scenes.h"
#include "tool/canvas/canvas_input.h"
#include "tool/canvas/canvas_overlay.h"
#include "tool/canvas/key_input.h"
#include "tool/canvas/lamp_menu.h"
#include "tool/panel/key_strip.h"
#include "tool/panel/lamp_panel.h"

#include <QDoubleSpinBox>
#include <QWheelEvent>

#include <memory>

using namespace lampblack;

class TimelineTest : public QObject
{
    Q_OBJECT

private:
    std::unique_ptr<FakeHost> mHost;
    std::unique_ptr<SceneDocument> mDocument;
    std::unique_ptr<QAction> mSurfaces;
    std::unique_ptr<QAction> mRender;
    std::unique_ptr<LampPanel> mPanel;
    CanvasOverlay* mOverlay = nullptr;
    CanvasInput* mInput = nullptr;
    KeyInput* mKeys = nullptr;

    const AreaLight& light() const { return mDocument->scene().lights[0]; }
    QPointF placeAt(int frame) const
    {
        const AreaLight there = lightAt(light(), frame);
        return {there.x, there.y};
    }
    int steps() const { return mDocument->undoStack()->count(); }
    template <typename Widget> Widget* find(const char* name) const
    {
        return mPanel->findChild<Widget*>(QStringLiteral("lampblack.panel.") + QLatin1String(name));
    }
    void press(const char* name) const { find<QToolButton>(name)->click(); }
    void keyAt(int frame)
    {
        mHost->goToFrame(frame);
        press("keys.here");
    }

private Q_SLOTS:
    void init()
    {
        mHost = std::make_unique<FakeHost>();
        mDocument = std::make_unique<SceneDocument>();
        mDocument->reset(sceneWithLight(200, 150, 200));
        mSurfaces = std::make_unique<QAction>();
        mRender = std::make_unique<QAction>();
        mPanel = std::make_unique<LampPanel>(*mHost, *mDocument, *mSurfaces, *mRender);
        mPanel->resize(200, 500);
        mPanel->show();
        mOverlay = new CanvasOverlay(*mHost, *mDocument);
        mInput = new CanvasInput(*mHost, *mDocument, *mOverlay);
        mKeys = new KeyInput(*mHost, *mDocument, *mOverlay, *mInput);
        mHost->open();
        mOverlay->show();
        mOverlay->updateHandles();
        mInput->setListening(true);
        mKeys->setListening(true);
    }

    void cleanup()
    {
        mPanel.reset();
        mHost.reset();
        mDocument.reset();
    }

    void handlesStandWhereTheLightIsAtTheFrame()
    {
        keyAt(1);
        mHost->goToFrame(5);
        dragMouse(mHost->mCanvas, {{200, 150}, {240, 150}, {280, 190}});
        QCOMPARE(keyFrames(light()), (QVector<int>{1, 5}));
        QCOMPARE(mOverlay->handles().lights()[0].centre, QPointF(280, 190));
        mHost->goToFrame(3);
        QCOMPARE(mOverlay->handles().lights()[0].centre, QPointF(240, 170));
        QCOMPARE(mOverlay->handles().lights()[0].path, QPolygonF(QVector<QPointF>{{200, 150}, {280, 190}}));
        QCOMPARE(mOverlay->handles().lights()[0].key, -1);
        mHost->goToFrame(1);
        QCOMPARE(mOverlay->handles().lights()[0].key, 0);
        QVERIFY(mOverlay->handles().region().contains(QPoint(240, 170)));
    }

    void aDragSetsTheKeyHereInOneStep()
    {
        keyAt(1);
        mHost->goToFrame(5);
        const int before = steps();
        dragMouse(mHost->mCanvas, {{200, 150}, {230, 150}, {260, 170}, {300, 180}});
        QCOMPARE(steps(), before + 1);
        QCOMPARE(placeAt(1), QPointF(200, 150));
        QCOMPARE(placeAt(5), QPointF(300, 180));
        dragMouse(mHost->mCanvas, {{300, 180}, {340, 180}});
        QCOMPARE(keyFrames(light()), (QVector<int>{1, 5}));
        mDocument->undoStack()->undo();
        mDocument->undoStack()->undo();
        QCOMPARE(keyFrames(light()), QVector<int>{1});
        mDocument->undoStack()->redo();
        QCOMPARE(placeAt(5), QPointF(300, 180));
    }

    void escapeTakesTheNewKeyAway()
    {
        keyAt(1);
        mHost->goToFrame(5);
        const Scene before = mDocument->scene();
        const int count = steps();
        dragMouse(mHost->mCanvas, {{200, 150}, {260, 170}}, Qt::NoModifier, false);
        QCOMPARE(keyFrames(light()).size(), 2);
        mInput->cancelDrag();
        QCOMPARE(mDocument->scene(), before);
        QCOMPARE(steps(), count);
    }

    void aDragThatComesBackMakesNoKey()
    {
        keyAt(1);
        mHost->goToFrame(5);
        dragMouse(mHost->mCanvas, {{200, 150}, {260, 170}, {200, 150}});
        QCOMPARE(keyFrames(light()), QVector<int>{1});
    }

    void wheelArrowsAndPanelChangeTheKeyHere()
    {
        keyAt(1);
        mHost->goToFrame(5);
        QWheelEvent wheel(QPointF(200, 150), QPointF(200, 150), QPoint(), QPoint(0, 120), Qt::NoButton,
                          Qt::NoModifier, Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(mHost->mCanvas, &wheel);
        QVERIFY(lightAt(light(), 5).z > 200);
        mHost->goToFrame(7);
        mHost->mCanvas->setFocus();
        QTRY_VERIFY(mHost->mCanvas->hasFocus());
        QTest::keyClick(mHost->mCanvas, Qt::Key_Right);
        QCOMPARE(placeAt(7), QPointF(201, 150));
        mHost->goToFrame(8);
        find<QDoubleSpinBox>("power.field")->setValue(3);
        QCOMPARE(keyFrames(light()), (QVector<int>{1, 5, 7, 8}));
        QCOMPARE(lightAt(light(), 8).power, 3.0);
        QCOMPARE(lightAt(light(), 1), lightAt(sceneWithLight(200, 150, 200).lights[0], 1));
        mHost->goToFrame(7);
        QCOMPARE(find<QDoubleSpinBox>("power.field")->value(), 1.2);
    }

    void aLightWithoutKeysIsTheSameEverywhere()
    {
        mHost->goToFrame(5);
        dragMouse(mHost->mCanvas, {{200, 150}, {260, 170}});
        QVERIFY(light().keys.isEmpty());
        QCOMPARE(placeAt(1), QPointF(260, 170));
    }

    void buttonsGoFromKeyToKey()
    {
        QVERIFY(!find<QToolButton>("keys.next")->isEnabled());
        keyAt(2);
        keyAt(6);
        mHost->goToFrame(4);
        press("keys.next");
        QCOMPARE(mHost->mFrame, 6);
        QVERIFY(!find<QToolButton>("keys.next")->isEnabled());
        press("keys.previous");
        QCOMPARE(mHost->mFrame, 2);
        press("keys.here");
        QCOMPARE(keyFrames(light()), QVector<int>{6});
        press("keys.next");
        press("keys.here");
        QVERIFY(light().keys.isEmpty());
    }

    void aClickOnTheStripFindsTheKeyNearIt()
    {
        keyAt(6);
        auto* strip = find<KeyStrip>("keys.strip");
        QTest::mouseClick(strip, Qt::LeftButton, Qt::NoModifier, QPoint(1, 8));
        QCOMPARE(mHost->mFrame, 1);
        QTest::mouseClick(strip, Qt::LeftButton, Qt::NoModifier,
                          QPoint(5 + (strip->width() - 10) * 5 / 7, 8));
        QCOMPARE(mHost->mFrame, 6);
    }

    void noMoreKeysThanAllowed()
    {
        Scene scene = mDocument->scene();
        for (int frame = 0; frame < MaxKeys; ++frame)
            scene.lights[0] = withKey(scene.lights[0], 2 * frame);
        mDocument->edit(QString(), scene);
        mHost->goToFrame(5);
        QVERIFY(!find<QToolButton>("keys.here")->isEnabled());
        dragMouse(mHost->mCanvas, {{200, 150}, {260, 170}});
        QCOMPARE(mDocument->scene(), scene);
    }

    void theFloorHasKeysToo()
    {
        QVERIFY(!find<QWidget>("floor.keys")->isEnabled());
        find<QAbstractButton>("floor")->click();
        press("floor.keys.here");
        mHost->goToFrame(5);
        find<QDoubleSpinBox>("floor.pitch.field")->setValue(45);
        QCOMPARE(keyFrames(*mDocument->scene().floor), (QVector<int>{1, 5}));
        mHost->goToFrame(3);
        QCOMPARE(find<QDoubleSpinBox>("floor.pitch.field")->value(), 35.0);
        const double y = mOverlay->handles().floor()->line.y1();
        dragMouse(mHost->mCanvas, {{50, y}, {50, y - 30}});
        QCOMPARE(floorAt(*mDocument->scene().floor, 3).y, y - 30);
        QCOMPARE(floorAt(*mDocument->scene().floor, 1).y, y);
    }

    void theMenuAddsAndRemovesKeys()
    {
        LampMenu menu(*mHost, *mDocument, nullptr);
        const auto entry = [&](const Handle& handle, const char* name)
        {
            menu.openAt({120, 80}, QPoint(), handle, QString());
            menu.close();
            return menu.findChild<QAction*>(QStringLiteral("lampblack.menu.") + QLatin1String(name));
        };
        const Handle sun{HandlePart::Light, 0};
        mHost->goToFrame(4);
        QVERIFY(entry({}, "add_key") == nullptr);
        QVERIFY(entry(sun, "remove_keys") == nullptr);
        entry(sun, "add_key")->trigger();
        mHost->goToFrame(6);
        entry(sun, "add_key")->trigger();
        QCOMPARE(keyFrames(light()), (QVector<int>{4, 6}));
        entry(sun, "remove_key")->trigger();
        QCOMPARE(keyFrames(light()), QVector<int>{4});
        entry(sun, "remove_keys")->trigger();
        QVERIFY(light().keys.isEmpty());
        entry({}, "floor")->trigger();
        entry({HandlePart::Floor, -1}, "add_key")->trigger();
        QCOMPARE(keyFrames(*mDocument->scene().floor), QVector<int>{6});
    }
};

QTEST_MAIN(TimelineTest)
#include "test_timeline.moc"
