// The Depth view under the pointer: clicks, strokes, the menu, and their undo.
#include "support/fake_host.h"
#include "support/fake_worker.h"
#include "support/mouse.h"
#include "support/scenes.h"
#include "tool/canvas/canvas_overlay.h"
#include "tool/depth/cut_editor.h"
#include "tool/lamp_tool.h"

#include <QMenu>

#include <memory>

using namespace lampblack;

class CutEditorTest : public QObject
{
    Q_OBJECT

private:
    std::unique_ptr<FakeHost> mHost;
    std::unique_ptr<FakeWorker> mWorker;
    std::unique_ptr<SceneDocument> mDocument;
    std::unique_ptr<LampTool> mTool;

    const QVector<DepthHint>& hints() const { return mDocument->scene().depth.hints; }
    QWidget* canvas() const { return mHost->mCanvas; }
    void click(const QPointF& at, Qt::MouseButton button = Qt::LeftButton) const
    {
        sendMouse(canvas(), QEvent::MouseMove, at, Qt::NoButton, Qt::NoButton);
        sendMouse(canvas(), QEvent::MouseButtonPress, at, button, button);
        sendMouse(canvas(), QEvent::MouseButtonRelease, at, button, Qt::NoButton);
    }
    QMenu* menu() const { return mHost->mCanvas->findChild<QMenu*>(QStringLiteral("lampblack.cut_menu")); }
    void choose(const QPointF& at, const char* name) const
    {
        click(at, Qt::RightButton);
        auto* action =
            menu()->findChild<QAction*>(QStringLiteral("lampblack.cut_menu.") + QLatin1String(name));
        QVERIFY2(action != nullptr && action->isEnabled(), name);
        action->trigger();
        menu()->close();
    }
    /// One cut from (100, 50) to (200, 50), its left (upper) side in front.
    void find() const
    {
        Overlap arm;
        arm.points = {{100, 50}, {200, 50}};
        arm.amount = 10;
        mTool->setOverlaps(mHost->mFrame, {arm});
    }

private Q_SLOTS:
    void init()
    {
        mHost = std::make_unique<FakeHost>();
        mWorker = std::make_unique<FakeWorker>();
        mDocument = std::make_unique<SceneDocument>();
        mDocument->reset(sceneWithLight(150, 50, 200)); // under the cut
        mTool = std::make_unique<LampTool>(*mHost, *mWorker, *mDocument);
        mHost->mFrame = 5;
        mHost->open();
        mTool->setViewMode(Show::Relief);
        QImage drawing(400, 300, QImage::Format_RGBA8888);
        drawing.fill(Qt::white);
        mTool->setFrame({5, drawing, {}, {}});
        find();
    }

    void cleanup()
    {
        mTool.reset();
        mHost.reset();
    }

    void oneClickBringsTheOtherSideInFront()
    {
        QCOMPARE(mTool->cuts().size(), 1);
        click({150, 53});
        QCOMPARE(hints().size(), 1);
        QCOMPARE(hints()[0].frame, 5);
        QCOMPARE(hints()[0].front, FrontSide::Right);
        QCOMPARE(mTool->cuts().size(), 1); // at once, before the worker answers
        QCOMPARE(mTool->cuts()[0].front, FrontSide::Right);
        click({150, 47});
        QCOMPARE(hints().size(), 1);
        QCOMPARE(hints()[0].front, FrontSide::Left);
        mDocument->undoStack()->undo();
        QCOMPARE(hints()[0].front, FrontSide::Right);
        mDocument->undoStack()->undo();
        QVERIFY(hints().isEmpty());
        QVERIFY(!mTool->cuts()[0].isCorrected);
        mDocument->undoStack()->redo();
        QCOMPARE(mTool->cuts()[0].front, FrontSide::Right);
    }

    void lightsAreOutOfReachMeanwhile()
    {
        const AreaLight before = mDocument->scene().lights[0];
        dragMouse(canvas(), {{150, 80}, {150, 100}, {150, 120}}); // over the light's ring
        dragMouse(canvas(), {{150, 50}, {150, 60}});
        QTest::keyClick(canvas(), Qt::Key_Left);
        QTest::keyClick(canvas(), Qt::Key_Delete);
        QCOMPARE(mDocument->scene().lights, QVector<AreaLight>{before});

        mTool->setViewMode(Show::Lit);
        QVERIFY(mTool->cuts().isEmpty());
        const int count = hints().size();
        dragMouse(canvas(), {{150, 50}, {170, 60}});
        QCOMPARE(mDocument->scene().lights[0].x, 170.0);
        QCOMPARE(hints().size(), count);
    }

    void aStrokeBecomesACut()
    {
        QVector<QPointF> way;
        for (int x = 250; x <= 350; x += 5)
            way.append({double(x), 200 + 10 * std::sin(x / 20.0)});
        dragMouse(canvas(), way);
        QCOMPARE(hints().size(), 1);
        QCOMPARE(hints()[0].front, FrontSide::Left);
        QVERIFY(hints()[0].points.size() > 2 && hints()[0].points.size() <= 16);
        QCOMPARE(hints()[0].points.first().x, 250.0);
        QCOMPARE(hints()[0].points.last().x, 350.0);
        click(way[10]);
        QCOMPARE(hints().size(), 1);
        QCOMPARE(hints()[0].front, FrontSide::Right);
        mDocument->undoStack()->undo();
        mDocument->undoStack()->undo();
        QVERIFY(hints().isEmpty());
    }

    void aClickOnNothingAndATinyDragDraftNothing()
    {
        click({300, 200});
        dragMouse(canvas(), {{300, 200}, {306, 200}});
        QCOMPARE(mDocument->undoStack()->count(), 0);
    }

    void escapeDropsTheStroke()
    {
        dragMouse(canvas(), {{250, 200}, {300, 200}}, Qt::NoModifier, false);
        QTest::keyClick(canvas(), Qt::Key_Escape);
        sendMouse(canvas(), QEvent::MouseButtonRelease, {300, 200}, Qt::LeftButton, Qt::NoButton);
        QVERIFY(hints().isEmpty());
    }

    void theMenuSaysTheRest()
    {
        choose({150, 50}, "apart");
        QCOMPARE(hints()[0].amount, 2.0 * 10 / 400);
        choose({150, 50}, "together");
        QCOMPARE(hints()[0].amount, 2.0 * 10 / 400 / 1.5);
        choose({150, 50}, "join");
        QCOMPARE(hints()[0].front, FrontSide::Joined);
        choose({150, 50}, "other_side");
        QCOMPARE(hints()[0].front, FrontSide::Left);
        choose({150, 50}, "remove");
        QVERIFY(hints().isEmpty());
        QCOMPARE(mDocument->undoStack()->count(), 5);
        choose({300, 200}, "light");
        QCOMPARE(mTool->viewMode(), std::optional<Show>(Show::Lit));
    }

    void deleteRemovesTheCorrectionUnderThePointer()
    {
        click({150, 50});
        QCOMPARE(hints().size(), 1);
        canvas()->setFocus();
        QTest::keyClick(canvas(), Qt::Key_Delete);
        QVERIFY(hints().isEmpty());
        QCOMPARE(mDocument->scene().lights.size(), 1);
    }

    void cutsOfAnotherFrameAreNotShown()
    {
        click({150, 50});
        mHost->goToFrame(6);
        QVERIFY(mTool->cuts().isEmpty());
        click({150, 50});
        QCOMPARE(hints().size(), 1);
        mHost->goToFrame(5);
        QCOMPARE(mTool->cuts().size(), 1);
        QCOMPARE(mTool->cuts()[0].hint, 0);
    }

    void whereTheViewIsTurnedTheCutIsStillHit()
    {
        const QTransform view = QTransform().translate(300, 20).rotate(90).scale(2, 2);
        mHost->setView(view);
        click(view.map(QPointF(150, 51)));
        QCOMPARE(hints().size(), 1);
        dragMouse(canvas(),
                  {view.map(QPointF(50, 100)), view.map(QPointF(60, 100)), view.map(QPointF(90, 100))});
        QCOMPARE(hints().size(), 2);
        QVERIFY(qAbs(hints()[1].points.last().x - 90) < 0.01);
        QVERIFY(qAbs(hints()[1].points.last().y - 100) < 0.01);
    }
};

QTEST_MAIN(CutEditorTest)
#include "test_cut_editor.moc"
