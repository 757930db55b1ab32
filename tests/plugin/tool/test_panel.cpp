// Panel and document agree, both ways, and neither echoes.
#include "support/fake_host.h"
#include "support/scenes.h"
#include "tool/panel/lamp_panel.h"
#include "tool/panel/value_row.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QScrollBar>
#include <QWheelEvent>
#include <QtTest/qtestspontaneevent.h>

#include <memory>

using namespace lampblack;

class PanelTest : public QObject
{
    Q_OBJECT

private:
    std::unique_ptr<FakeHost> mHost;
    std::unique_ptr<SceneDocument> mDocument;
    std::unique_ptr<QAction> mRender;
    std::unique_ptr<LampPanel> mPanel;

    template <typename Widget> Widget* find(const char* name) const
    {
        return mPanel->findChild<Widget*>(QStringLiteral("lampblack.panel.") + QLatin1String(name));
    }
    const AreaLight& light() const { return mDocument->scene().lights[0]; }

private Q_SLOTS:
    void init()
    {
        mHost = std::make_unique<FakeHost>();
        mDocument = std::make_unique<SceneDocument>();
        mDocument->reset(sceneWithLight(200, 150, 200));
        mRender = std::make_unique<QAction>();
        mPanel = std::make_unique<LampPanel>(*mHost, *mDocument, *mRender);
        mPanel->resize(200, 500);
        mPanel->show();
    }

    void cleanup() { mPanel.reset(); }

    void fitsANarrowDock() { QVERIFY(mPanel->widget()->minimumSizeHint().width() <= 190); }

    void slidersSpreadTheirValues_data()
    {
        QTest::addColumn<double>("value");
        for (const double value : {-400.0, -12.0, 0.0, 3.0, 200.0, 399.0})
            QTest::newRow(qPrintable(QString::number(value))) << value;
    }

    void slidersSpreadTheirValues()
    {
        QFETCH(double, value);
        const SliderScale scale{-1e5, 1e5, 400, 2, true, 0};
        QVERIFY(qAbs(scale.valueAt(scale.positionOf(value)) - value) < 1e-6);
        QCOMPARE(scale.positionOf(1000), 1.0);
    }

    void theDocumentShowsInThePanel()
    {
        Scene scene = mDocument->scene();
        scene.lights[0].power = 3.5;
        scene.ambient.strength = 0.7;
        scene.quality = Quality::Final;
        scene.floor = Floor();
        scene.floor->pitch = 40;
        mDocument->edit(QString(), scene);
        QCOMPARE(find<QDoubleSpinBox>("power.field")->value(), 3.5);
        QCOMPARE(find<QDoubleSpinBox>("ambient.field")->value(), 0.7);
        QCOMPARE(find<QComboBox>("quality")->currentIndex(), 2);
        QVERIFY(find<QCheckBox>("floor")->isChecked());
        QCOMPARE(find<QDoubleSpinBox>("floor.pitch.field")->value(), 40.0);
        QCOMPARE(mDocument->undoStack()->count(), 1); // showing is not editing
    }

    void roundedFieldsLeaveTheSceneExact()
    {
        Scene scene = mDocument->scene();
        scene.lights[0].z = 123.456;
        scene.reliefScale = 0.98765;
        mDocument->edit(QString(), scene);
        QCOMPARE(light().z, 123.456);
        QCOMPARE(mDocument->scene().reliefScale, 0.98765);
    }

    void aSlideIsOneStep()
    {
        auto* power = find<QSlider>("power");
        power->setSliderDown(true);
        for (int position = 300; position <= 700; position += 50)
            power->setSliderPosition(position);
        power->setSliderDown(false);
        QCOMPARE(mDocument->undoStack()->count(), 1);
        QVERIFY(light().power > 1);
        QCOMPARE(find<QDoubleSpinBox>("power.field")->value(), light().power);
        mDocument->undoStack()->undo();
        QCOMPARE(light().power, 1.2);
        QCOMPARE(find<QDoubleSpinBox>("power.field")->value(), 1.2);
    }

    void aWheelThatScrollsThePanelChangesNothing()
    {
        QVERIFY(QTest::qWaitForWindowExposed(mPanel.get()));
        QTRY_VERIFY(mPanel->verticalScrollBar()->maximum() > 0);
        for (const char* name : {"power", "floor.pitch", "quality", "power.field"})
        {
            auto* control = find<QWidget>(name);
            QWheelEvent event(QPointF(5, 5), control->mapToGlobal(QPointF(5, 5).toPoint()), QPoint(),
                              QPoint(0, -120), Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
            QSpontaneKeyEvent::setSpontaneous(&event); // only such are passed on to parents
            qApp->notify(control, &event);
        }
        QCOMPARE(mDocument->undoStack()->count(), 0);
        QVERIFY(mPanel->verticalScrollBar()->value() > 0);
    }

    void aTypedNumberCountsOnceItIsWhole()
    {
        auto* height = find<QDoubleSpinBox>("height.field");
        height->setFocus();
        height->selectAll();
        QTest::keyClicks(height, QStringLiteral("-75"));
        QCOMPARE(light().z, 200.0);
        QTest::keyClick(height, Qt::Key_Return);
        QCOMPARE(light().z, -75.0);
        QCOMPARE(mDocument->undoStack()->count(), 1);
    }

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

    void theDepthOfALayerIsChosenAndUndone()
    {
        const auto choice = [this]
        {
            return find<QComboBox>("body.Line");
        };
        QCOMPARE(choice()->currentData().toInt(), int(BodyChoice::Auto));
        Q_EMIT choice()->activated(choice()->findData(int(BodyChoice::Own)));
        QCOMPARE(mDocument->scene().depth.layers,
                 (QVector<LayerBody>{{QStringLiteral("Line"), BodyChoice::Own, {}}}));
        QCOMPARE(choice()->currentData().toInt(), int(BodyChoice::Own));
        Q_EMIT choice()->activated(choice()->findData(int(BodyChoice::Flat)));
        QCOMPARE(mDocument->scene().depth.layers.size(), 1);
        mDocument->undoStack()->undo();
        QCOMPARE(choice()->currentData().toInt(), int(BodyChoice::Own));
        mDocument->undoStack()->undo();
        QVERIFY(mDocument->scene().depth.layers.isEmpty());
    }

    void theLowestLayerHasNoDepthToChoose()
    {
        QVERIFY(find<QComboBox>("body.Line") && !find<QComboBox>("body.Hills"));
        auto* role = find<QComboBox>("layer.Hills");
        Q_EMIT role->activated(role->findData(QStringLiteral("background")));
        QVERIFY(!find<QComboBox>("body.Line"));
    }

    void theFloorBoxPutsAFloorUnderTheFeet()
    {
        find<QCheckBox>("floor")->click();
        QCOMPARE(mDocument->scene().floor->y, 270.0);
        find<QCheckBox>("floor")->click();
        QVERIFY(!mDocument->scene().floor);
        QVERIFY(!find<QSlider>("floor.pitch")->isEnabled());
    }

    void roughnessFollowsTheDefaultUnlessItIsOnesOwn()
    {
        Scene scene = mDocument->scene();
        Material shiny;
        shiny.glossy = true;
        scene.materials.insert(QStringLiteral("#111111"), shiny);
        shiny.roughness = 0.8;
        scene.materials.insert(QStringLiteral("#222222"), shiny);
        mDocument->edit(QString(), scene);
        find<QDoubleSpinBox>("roughness.field")->setValue(0.5);
        QCOMPARE(mDocument->scene().defaultMaterial.roughness, 0.5);
        QCOMPARE(materialOf(mDocument->scene(), QStringLiteral("#111111")).roughness, 0.5);
        QCOMPARE(materialOf(mDocument->scene(), QStringLiteral("#222222")).roughness, 0.8);
    }

    void layersHaveRoles()
    {
        QVERIFY2(find<QComboBox>("layer.Camera") == nullptr, "a camera is not drawn");
        auto* hills = find<QComboBox>("layer.Hills");
        QCOMPARE(hills->currentIndex(), 0);
        hills->setCurrentIndex(2);
        Q_EMIT hills->activated(2);
        const QMap<QString, QString> roles = mDocument->layerRoles();
        QCOMPARE(roles.value(QStringLiteral("Hills")), QStringLiteral("background"));
        QCOMPARE(roles.value(QStringLiteral("Line")), QStringLiteral("character"));
        mHost->mLayers.removeLast();
        Q_EMIT mHost->layersChanged();
        QVERIFY(find<QComboBox>("layer.Hills") == nullptr);
        QCOMPARE(find<QComboBox>("layer.Line")->currentIndex(), 0);
    }

    void progressShowsAndCanBeCancelled()
    {
        QSignalSpy cancelled(mPanel->render(), &RenderSection::cancelRequested);
        QVERIFY(!find<QPushButton>("cancel")->isVisibleTo(mPanel.get()));
        mPanel->render()->setRenderProgress(3, 8);
        QCOMPARE(find<QProgressBar>("render.progress")->value(), 3);
        QVERIFY(!find<QPushButton>("generate")->isEnabled());
        QVERIFY(!mRender->isEnabled());
        find<QPushButton>("cancel")->click();
        QCOMPARE(cancelled.count(), 1);
        mPanel->render()->setRenderProgress(0, 0);
        QVERIFY(!find<QPushButton>("cancel")->isVisibleTo(mPanel.get()));
        QVERIFY(mRender->isEnabled());
    }

    void aProblemSaysWhatToDoAndIsCopied()
    {
        auto* card = find<ProblemCard>("problem");
        QVERIFY(!card->isVisibleTo(mPanel.get()));
        mPanel->showProblem({QStringLiteral("The worker is gone."), QStringLiteral("Type: make install"),
                             QStringLiteral("exit 1 <b>raw</b>")});
        QVERIFY(card->isVisibleTo(mPanel.get()));
        QVERIFY(card->report().contains(QStringLiteral("exit 1 <b>raw</b>")));
        find<QToolButton>("problem.dismiss")->click();
        QVERIFY(!card->isVisibleTo(mPanel.get()));
    }

    void everyControlHasANameAndTakesTheKeyboard()
    {
        for (const char* name : {"power", "size", "height", "ambient", "relief", "roughness", "floor.pitch"})
        {
            QVERIFY(!find<QSlider>(name)->accessibleName().isEmpty());
            QVERIFY(find<QSlider>(name)->focusPolicy() & Qt::TabFocus);
        }
        for (const char* name : {"view.lit", "view.flat", "light.1", "light.add", "colour"})
            QVERIFY2(find<QToolButton>(name)->focusPolicy() & Qt::TabFocus, name);
    }
};

QTEST_MAIN(PanelTest)
#include "test_panel.moc"
