// Mouse, pen and wheel on the canvas become edits, one undo step a gesture.
#include "support/fake_host.h"
#include "support/mouse.h"
#include "support/scenes.h"
#include "tool/canvas/canvas_input.h"
#include "tool/canvas/canvas_overlay.h"

#include <QTabletEvent>
#include <QWheelEvent>

#include <memory>

using namespace lampblack;

class DragTest : public QObject
{
    Q_OBJECT

private:
    std::unique_ptr<FakeHost> mHost;
    std::unique_ptr<SceneDocument> mDocument;
    CanvasOverlay* mOverlay = nullptr;
    CanvasInput* mInput = nullptr;

    const AreaLight& light() const { return mDocument->scene().lights[0]; }
    QPointF place() const { return mHost->mView->map(QPointF(light().x, light().y)); }

    void wheel(const QPointF& at, int notches, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
    {
        QWheelEvent event(at, at, QPoint(), QPoint(0, 120 * notches), Qt::NoButton, modifiers,
                          Qt::NoScrollPhase, false);
        QCoreApplication::sendEvent(mHost->mCanvas, &event);
    }

    void pen(QEvent::Type type, const QPointF& at, Qt::MouseButton button, Qt::MouseButtons held)
    {
        QTabletEvent event(type, at, at, QTabletEvent::Stylus, QTabletEvent::Pen, 0.5, 0, 0, 0, 0, 0,
                           Qt::NoModifier, 1, button, held);
        event.ignore();
        QCoreApplication::sendEvent(mHost->mCanvas, &event);
    }

private Q_SLOTS:
    void init()
    {
        mHost = std::make_unique<FakeHost>();
        mDocument = std::make_unique<SceneDocument>();
        mDocument->reset(sceneWithLight(200, 150, 200));
        mOverlay = new CanvasOverlay(*mHost, *mDocument);
        mInput = new CanvasInput(*mHost, *mDocument, *mOverlay);
        mHost->open();
        mOverlay->show();
        mOverlay->updateHandles();
        mInput->setListening(true);
    }

    void cleanup()
    {
        mHost.reset();
        mDocument.reset();
    }

    void aDragMovesTheLightInOneStep_data()
    {
        QTest::addColumn<QTransform>("view");
        QTest::newRow("plain") << QTransform();
        QTest::newRow("33 %") << QTransform::fromScale(0.33, 0.33);
        QTest::newRow("300 %") << QTransform(3, 0, 0, 3, -300, -200);
        QTest::newRow("turned") << QTransform().translate(200, 40).rotate(30);
        QTest::newRow("flipped") << QTransform(-1, 0, 0, 1, 420, 0);
    }

    void aDragMovesTheLightInOneStep()
    {
        QFETCH(QTransform, view);
        mHost->setView(view);
        const QPointF from = place();
        const QPointF to = from + QPointF(40, 25);
        dragMouse(mHost->mCanvas, {from + QPointF(3, 2), from + QPointF(20, 10), to + QPointF(3, 2)});
        const QPointF canvas = view.inverted().map(to);
        QVERIFY(QLineF(canvas, QPointF(light().x, light().y)).length() < 1e-6);
        QCOMPARE(mDocument->undoStack()->count(), 1);
        mDocument->undoStack()->undo();
        QCOMPARE(light().x, 200.0);
        QCOMPARE(light().y, 150.0);
    }

    void aShakyClickMovesNothing()
    {
        dragMouse(mHost->mCanvas, {place(), place() + QPointF(1, 1)});
        QCOMPARE(mDocument->undoStack()->count(), 0);
        QCOMPARE(mDocument->selectedLight(), 0);
    }

    void shiftKeepsTheMoveLevel()
    {
        dragMouse(mHost->mCanvas, {place(), place() + QPointF(50, 9)}, Qt::ShiftModifier);
        QCOMPARE(light().x, 250.0);
        QCOMPARE(light().y, 150.0);
    }

    void escapeBringsTheLightBack()
    {
        dragMouse(mHost->mCanvas, {place(), place() + QPointF(50, 9)}, Qt::NoModifier, false);
        QCOMPARE(light().x, 250.0);
        mInput->cancelDrag();
        QCOMPARE(light().x, 200.0);
        QCOMPARE(mDocument->undoStack()->count(), 0);
        // The button is still down: what follows is not a new drag.
        sendMouse(mHost->mCanvas, QEvent::MouseMove, {300, 300}, Qt::NoButton, Qt::LeftButton);
        sendMouse(mHost->mCanvas, QEvent::MouseButtonRelease, {300, 300}, Qt::LeftButton, Qt::NoButton);
        QCOMPARE(light().x, 200.0);
    }

    void theRingDragsTheSize()
    {
        mDocument->selectLight(0);
        const QPointF rim = place() + QPointF(-50, 0);
        dragMouse(mHost->mCanvas, {rim, rim - QPointF(10, 0), rim - QPointF(25, 0)});
        QCOMPARE(light().size, 150.0);
        QCOMPARE(light().x, 200.0);
    }

    void theGripDragsThroughThePaper()
    {
        const QPointF grip = mOverlay->handles().lights()[0].grip;
        dragMouse(mHost->mCanvas, {grip, place(), place() + QPointF(0, 60)});
        QVERIFY(light().z < 0);
        QCOMPARE(light().y, 150.0);
        QCOMPARE(mDocument->undoStack()->count(), 1);
    }

    void altDragChangesTheHeight()
    {
        const double before = light().z;
        dragMouse(mHost->mCanvas, {place(), place() - QPointF(0, 20)}, Qt::AltModifier);
        QVERIFY(light().z > before);
        QCOMPARE(light().y, 150.0);
    }

    void theWheelGoesThroughThePaperInOneStep()
    {
        for (int notch = 0; notch < 20; ++notch)
            wheel(place(), -1);
        QVERIFY(light().z < 0);
        QCOMPARE(mDocument->undoStack()->count(), 1);
        mDocument->undoStack()->undo();
        QCOMPARE(light().z, 200.0);
    }

    void theWheelBesideALightIsNotOurs()
    {
        QWheelEvent event(QPointF(20, 20), QPointF(20, 20), QPoint(), QPoint(0, 120), Qt::NoButton,
                          Qt::NoModifier, Qt::NoScrollPhase, false);
        event.ignore();
        QCoreApplication::sendEvent(mHost->mCanvas, &event);
        QVERIFY(!event.isAccepted());
        QCOMPARE(mDocument->undoStack()->count(), 0);
    }

    void aLightThatComesUnderAZoomingPointerIsPassedBy()
    {
        wheel({20, 20}, 1);
        mHost->setView(QTransform::fromTranslate(20 - 200, 20 - 150));
        wheel({20, 20}, 1);
        QCOMPARE(light().z, 200.0);
    }

    void theFloorMovesAndPitches()
    {
        Scene scene = mDocument->scene();
        scene.floor = Floor();
        scene.floor->y = 250;
        mDocument->reset(scene);
        dragMouse(mHost->mCanvas, {{100, 250}, {100, 262}, {110, 270}});
        QCOMPARE(mDocument->scene().floor->y, 270.0);
        QCOMPARE(mDocument->undoStack()->count(), 1);
        wheel({100, 270}, 2);
        QCOMPARE(mDocument->scene().floor->pitch, 30.0);
        dragMouse(mHost->mCanvas, {{100, 270}, {100, 290}}, Qt::AltModifier);
        QCOMPARE(mDocument->scene().floor->pitch, 40.0);
        QCOMPARE(mDocument->scene().floor->y, 270.0);
    }

    void aPenDragsAsAMouseDoes()
    {
        pen(QEvent::TabletPress, place(), Qt::LeftButton, Qt::LeftButton);
        // Some window systems send a mouse along: it counts once.
        sendMouse(mHost->mCanvas, QEvent::MouseButtonPress, place(), Qt::LeftButton, Qt::LeftButton);
        pen(QEvent::TabletMove, {220, 150}, Qt::NoButton, Qt::LeftButton);
        sendMouse(mHost->mCanvas, QEvent::MouseMove, {90, 90}, Qt::NoButton, Qt::LeftButton);
        pen(QEvent::TabletMove, {260, 170}, Qt::NoButton, Qt::LeftButton);
        pen(QEvent::TabletRelease, {260, 170}, Qt::LeftButton, Qt::NoButton);
        QCOMPARE(light().x, 260.0);
        QCOMPARE(light().y, 170.0);
        QCOMPARE(mDocument->undoStack()->count(), 1);
    }

    void aClickBesideEverythingDrawsNothing()
    {
        QMouseEvent press(QEvent::MouseButtonPress, QPointF(20, 280), Qt::LeftButton, Qt::LeftButton,
                          Qt::NoModifier);
        QCoreApplication::sendEvent(mHost->mCanvas, &press);
        QVERIFY(press.isAccepted());
        QCOMPARE(mDocument->selectedLight(), 0);
    }

    void panningAndZoomingPassThrough()
    {
        QMouseEvent middle(QEvent::MouseButtonPress, place(), Qt::MiddleButton, Qt::MiddleButton,
                           Qt::NoModifier);
        middle.ignore();
        QCoreApplication::sendEvent(mHost->mCanvas, &middle);
        QVERIFY(!middle.isAccepted());
    }

    void anUnknownViewLeavesTheCanvasAlone()
    {
        mHost->mView.reset();
        Q_EMIT mHost->viewChanged();
        dragMouse(mHost->mCanvas, {{200, 150}, {260, 190}});
        QCOMPARE(mDocument->undoStack()->count(), 0);
    }

    void theCursorComesBack()
    {
        mHost->mCanvas->setCursor(Qt::WaitCursor);
        mInput->setListening(false);
        mInput->setListening(true);
        sendMouse(mHost->mCanvas, QEvent::MouseMove, place(), Qt::NoButton, Qt::NoButton);
        QCOMPARE(mHost->mCanvas->cursor().shape(), Qt::ArrowCursor);
        mInput->setListening(false);
        QCOMPARE(mHost->mCanvas->cursor().shape(), Qt::WaitCursor);
        mInput->setListening(true);
        mHost->mCanvas->setCursor(Qt::IBeamCursor); // another tool took over meanwhile
        mInput->setListening(false);
        QCOMPARE(mHost->mCanvas->cursor().shape(), Qt::IBeamCursor);
    }

    void aLostSceneEndsTheDragQuietly()
    {
        dragMouse(mHost->mCanvas, {place(), place() + QPointF(50, 9)}, Qt::NoModifier, false);
        Scene empty = mDocument->scene();
        empty.lights.clear();
        mDocument->reset(empty);
        sendMouse(mHost->mCanvas, QEvent::MouseMove, {300, 300}, Qt::NoButton, Qt::LeftButton);
        mInput->cancelDrag();
        QCOMPARE(mDocument->undoStack()->count(), 0);
    }
};

QTEST_MAIN(DragTest)
#include "test_drag.moc"
