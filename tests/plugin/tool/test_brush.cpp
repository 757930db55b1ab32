// The brush of the Depth view: strokes, wheel, menu, and their undo.
#include "support/fake_host.h"
#include "support/fake_worker.h"
#include "support/mouse.h"
#include "support/scenes.h"
#include "tool/depth/colour_depth.h"
#include "tool/depth/stroke_edit.h"
#include "tool/lamp_tool.h"

#include <QMenu>
#include <QToolButton>
#include <QWheelEvent>

#include <memory>

using namespace lampblack;

class BrushTest : public QObject
{
    Q_OBJECT

private:
    std::unique_ptr<FakeHost> mHost;
    std::unique_ptr<FakeWorker> mWorker;
    std::unique_ptr<SceneDocument> mDocument;
    std::unique_ptr<LampTool> mTool;

    const QVector<DepthStroke>& strokes() const { return mDocument->scene().depth.strokes; }
    QWidget* canvas() const { return mHost->mCanvas; }
    void choose(const char* brush) const
    {
        auto* button =
            canvas()->findChild<QToolButton*>(QStringLiteral("lampblack.brush_bar.") + QLatin1String(brush));
        QVERIFY2(button != nullptr && button->isVisible(), brush);
        button->click();
    }
    void click(const QPointF& at, Qt::MouseButton button = Qt::LeftButton) const
    {
        sendMouse(canvas(), QEvent::MouseMove, at, Qt::NoButton, Qt::NoButton);
        sendMouse(canvas(), QEvent::MouseButtonPress, at, button, button);
        sendMouse(canvas(), QEvent::MouseButtonRelease, at, button, Qt::NoButton);
    }
    bool turnWheel(int notches, Qt::KeyboardModifiers modifiers = Qt::NoModifier) const
    {
        QWheelEvent wheel(QPointF(100, 100), canvas()->mapToGlobal(QPoint(100, 100)), {}, {0, 120 * notches},
                          Qt::NoButton, modifiers, Qt::NoScrollPhase, false);
        wheel.ignore();
        QCoreApplication::sendEvent(canvas(), &wheel);
        return wheel.isAccepted();
    }

private Q_SLOTS:
    void init()
    {
        mHost = std::make_unique<FakeHost>();
        mWorker = std::make_unique<FakeWorker>();
        mDocument = std::make_unique<SceneDocument>();
        mDocument->reset(sceneWithLight(150, 50, 200));
        mTool = std::make_unique<LampTool>(*mHost, *mWorker, *mDocument);
        mHost->mFrame = 5;
        mHost->open();
        mTool->setViewMode(Show::Relief);
    }

    void cleanup()
    {
        mTool.reset();
        mHost.reset();
    }

    void aDragIsAStrokeOfTheChosenBrush()
    {
        const double side = std::max(mDocument->scene().canvas.width, mDocument->scene().canvas.height);
        choose("bump");
        dragMouse(canvas(), {{100, 100}, {120, 100}, {150, 110}});
        choose("dent");
        click({60, 60});
        choose("turn");
        dragMouse(canvas(), {{200, 100}, {200, 150}});
        QCOMPARE(strokes().size(), 3);
        QCOMPARE(strokes()[0].brush, Brush::Bump);
        QCOMPARE(strokes()[0].frame, 5);
        QCOMPARE(strokes()[0].points.first().x, 100.0);
        QCOMPARE(strokes()[0].points.last().y, 110.0);
        QCOMPARE(strokes()[0].radius, 0.04 * side);
        QCOMPARE(strokes()[1].brush, Brush::Dent);
        QCOMPARE(strokes()[1].points.size(), 1);
        QCOMPARE(strokes()[2].brush, Brush::Turn);
        mDocument->undoStack()->undo();
        mDocument->undoStack()->undo();
        QCOMPARE(strokes().size(), 1);
        mDocument->undoStack()->redo();
        QCOMPARE(strokes().size(), 2);
        QVERIFY(mDocument->scene().depth.hints.isEmpty());
    }

    void aPartIsSaidToBeRoundOrHollow()
    {
        choose("hollow");
        dragMouse(canvas(), {{100, 100}, {150, 110}});
        choose("round");
        click({60, 60});
        QCOMPARE(strokes().size(), 2);
        QCOMPARE(strokes()[0].brush, Brush::Hollow);
        QCOMPARE(strokes()[1].brush, Brush::Round);
        QCOMPARE(mDocument->undoStack()->undoText(), QStringLiteral("Round"));
    }

    void aTurnNeedsAWay()
    {
        choose("turn");
        click({60, 60});
        QVERIFY(strokes().isEmpty());
        QCOMPARE(mDocument->undoStack()->count(), 0);
    }

    void longStrokesKeepTheirShapeInFewPoints()
    {
        choose("bump");
        QVector<QPointF> way;
        for (int x = 20; x < 380; x += 4)
            way.append({double(x), 100 + 40 * std::sin(x / 30.0)});
        dragMouse(canvas(), way);
        QCOMPARE(strokes().size(), 1);
        QVERIFY(strokes()[0].points.size() > 8 && strokes()[0].points.size() <= MaxStrokePoints);
    }

    void theWheelSetsRadiusAndStrength()
    {
        choose("bump");
        click({100, 100});
        QVERIFY(turnWheel(2));
        QVERIFY(turnWheel(-4, Qt::ShiftModifier));
        click({150, 100});
        QVERIFY(strokes()[1].radius > 1.2 * strokes()[0].radius);
        QVERIFY(qAbs(strokes()[1].amount - (strokes()[0].amount - 0.2)) < 1e-9);
        QVERIFY(!turnWheel(1, Qt::ControlModifier)); // zooms
        for (int i = 0; i < 100; ++i)
        {
            turnWheel(-5);
            turnWheel(-5, Qt::ShiftModifier);
        }
        click({180, 100});
        QVERIFY(strokes()[2].radius >= 1 && strokes()[2].amount > 0);
    }

    void escapeDropsTheStroke()
    {
        choose("bump");
        dragMouse(canvas(), {{100, 100}, {150, 100}}, Qt::NoModifier, false);
        QTest::keyClick(canvas(), Qt::Key_Escape);
        sendMouse(canvas(), QEvent::MouseButtonRelease, {150, 100}, Qt::LeftButton, Qt::NoButton);
        QVERIFY(strokes().isEmpty());
    }

    void whatIsUnderThePointerIsRemoved()
    {
        choose("bump");
        click({100, 100});
        click({200, 100});
        canvas()->setFocus();
        sendMouse(canvas(), QEvent::MouseMove, {101, 100}, Qt::NoButton, Qt::NoButton);
        QTest::keyClick(canvas(), Qt::Key_Delete);
        QCOMPARE(strokes().size(), 1);
        QCOMPARE(strokes()[0].points.first().x, 200.0);
        QCOMPARE(mDocument->scene().lights.size(), 1);
        click({200, 101}, Qt::RightButton);
        auto* menu = canvas()->findChild<QMenu*>(QStringLiteral("lampblack.cut_menu"));
        auto* remove = menu->findChild<QAction*>(QStringLiteral("lampblack.cut_menu.remove_stroke"));
        QVERIFY(remove != nullptr);
        remove->trigger();
        menu->close();
        QVERIFY(strokes().isEmpty());
    }

    void strokesOfAnotherFrameAreLeftAlone()
    {
        choose("bump");
        click({100, 100});
        mHost->goToFrame(6);
        sendMouse(canvas(), QEvent::MouseMove, {100, 100}, Qt::NoButton, Qt::NoButton);
        canvas()->setFocus();
        QTest::keyClick(canvas(), Qt::Key_Delete);
        QCOMPARE(strokes().size(), 1);
        QCOMPARE(withoutStrokes(mDocument->scene(), 6).depth.strokes.size(), 1);
        QVERIFY(withoutStrokes(mDocument->scene(), 5).depth.strokes.isEmpty());
    }

    void thereIsRoomForSoMany()
    {
        Scene scene = mDocument->scene();
        for (int i = 0; i < MaxStrokes + 5; ++i)
            scene = withStroke(scene, 1, QPolygonF({{1, 1}}), {});
        QCOMPARE(scene.depth.strokes.size(), MaxStrokes);
        mDocument->reset(scene);
        choose("bump");
        click({100, 100});
        QCOMPARE(strokes().size(), MaxStrokes);
        QVERIFY(mHost->mStatus.contains(QString::number(MaxStrokes)));
    }

    void aColourBecomesRounderAndNearer()
    {
        QImage drawing(400, 300, QImage::Format_RGBA8888);
        drawing.fill(QColor(200, 60, 40));
        mTool->setFrame({5, drawing, {}, {}});
        mTool->setPalette({{QStringLiteral("#c83c28"), 120000}});
        const auto chosen = [this](const char* name)
        {
            click({300, 200}, Qt::RightButton);
            auto* menu = canvas()->findChild<QMenu*>(QStringLiteral("lampblack.cut_menu"));
            auto* entry =
                menu->findChild<QAction*>(QStringLiteral("lampblack.cut_menu.") + QLatin1String(name));
            const bool isThere = entry != nullptr && entry->isEnabled();
            if (isThere)
                entry->trigger();
            menu->close();
            return isThere;
        };
        const QVector<DepthColour>& colours = mDocument->scene().depth.colours;
        QVERIFY(!chosen("as_found"));
        QVERIFY(chosen("rounder"));
        QCOMPARE(colours.size(), 1);
        QCOMPARE(colours[0].colour, QColor(200, 60, 40));
        QCOMPARE(colours[0].volume, 1.5);
        choose("bump"); // with the brush too
        QVERIFY(chosen("nearer"));
        QCOMPARE(colours[0].nearer, 0.02);
        QVERIFY(chosen("flatter"));
        QVERIFY(chosen("farther"));
        QVERIFY2(colours.isEmpty(), "nothing is said of it any more");
        mDocument->undoStack()->undo();
        QCOMPARE(colours.size(), 1);
        QVERIFY(chosen("as_found"));
        QVERIFY(colours.isEmpty());
        for (int i = 0; i < 8; ++i)
            chosen("flatter");
        QCOMPARE(colours[0].volume, 0.0);
        QVERIFY(!chosen("flatter"));
        for (int i = 0; i < 12; ++i)
            chosen("rounder");
        QCOMPARE(colours[0].volume, MaxVolume);
    }

    void stepsAndLightsAreAsBefore()
    {
        choose("bump");
        choose("step");
        QVector<QPointF> way;
        for (int x = 250; x <= 350; x += 5)
            way.append({double(x), 200.0});
        dragMouse(canvas(), way);
        QVERIFY(strokes().isEmpty());
        QCOMPARE(mDocument->scene().depth.hints.size(), 1);
        choose("dent");
        mTool->setViewMode(Show::Lit);
        auto* bar = canvas()->findChild<QWidget*>(QStringLiteral("lampblack.brush_bar"));
        QVERIFY(!bar->isVisible());
        dragMouse(canvas(), {{150, 50}, {170, 60}});
        QCOMPARE(mDocument->scene().lights[0].x, 170.0);
        QVERIFY(strokes().isEmpty());
    }
};

QTEST_MAIN(BrushTest)
#include "test_brush.moc"
