// Panel and document agree, both ways, and neither echoes.
#include "support/fake_host.h"
#include "support/fake_worker.h"
#include "support/scenes.h"
#include "tool/panel/colour_button.h"
#include "tool/panel/elided_label.h"
#include "tool/panel/lamp_panel.h"
#include "tool/panel/light_links.h"
#include "tool/panel/rig_menu.h"
#include "tool/panel/rig_pictures.h"
#include "tool/panel/value_row.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QProgressBar>
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
    std::unique_ptr<QAction> mSurfaces;
    std::unique_ptr<QAction> mRender;
    std::unique_ptr<LampPanel> mPanel;

    template <typename Widget> Widget* find(const char* name) const
    {
        return mPanel->findChild<Widget*>(QStringLiteral("lampblack.panel.") + QLatin1String(name));
    }
    void makePanel() { mPanel = std::make_unique<LampPanel>(*mHost, *mDocument, *mSurfaces, *mRender); }
    const AreaLight& light() const { return mDocument->scene().lights[0]; }

private Q_SLOTS:
    void init()
    {
        mHost = std::make_unique<FakeHost>();
        mDocument = std::make_unique<SceneDocument>();
        mDocument->reset(sceneWithLight(200, 150, 200));
        mSurfaces = std::make_unique<QAction>();
        mRender = std::make_unique<QAction>();
        makePanel();
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

    void aLookIsChosenByItsPicture()
    {
        const Scene before = mDocument->scene();
        QVERIFY(find<QToolButton>("look.smooth")->isChecked());
        QVERIFY(!find<QToolButton>("look.hard-cel")->icon().isNull());
        QTest::mouseClick(find<QToolButton>("look.hard-cel"), Qt::LeftButton);
        QCOMPARE(mDocument->scene().look.tones.size(), 1);
        QVERIFY(find<QToolButton>("look.hard-cel")->isChecked());
        QVERIFY(!find<QToolButton>("look.smooth")->isChecked());
        QTest::mouseClick(find<QToolButton>("look.two-tone-rim"), Qt::LeftButton);
        QVERIFY(mDocument->scene().rim && find<QCheckBox>("look.rim_on")->isChecked());
        find<QDoubleSpinBox>("look.softness.field")->setValue(0.3);
        QVERIFY2(!find<QToolButton>("look.two-tone-rim")->isChecked(), "the look is one's own now");
        for (int step = 0; step < 3; ++step)
            mDocument->undoStack()->undo();
        QVERIFY(mDocument->scene() == before);
        QVERIFY(find<QToolButton>("look.smooth")->isChecked());
    }

    void tonesAreCountedAndTheirEdgesMoved()
    {
        auto* count = find<QComboBox>("look.tones");
        QVERIFY(find<QWidget>("look.tone.1.row")->isHidden());
        Q_EMIT count->activated(2);
        QCOMPARE(mDocument->scene().look.tones.size(), 2);
        QVERIFY(!find<QWidget>("look.tone.2.row")->isHidden());
        find<QDoubleSpinBox>("look.tone.2.field")->setValue(0.9);
        QCOMPARE(mDocument->scene().look.tones[1], 0.9);
        Q_EMIT count->activated(0);
        QVERIFY(mDocument->scene().look.tones.isEmpty());
    }

    void shadeInkAndRimHaveTheirNumbers()
    {
        find<QDoubleSpinBox>("look.shade.field")->setValue(0.4);
        find<QDoubleSpinBox>("look.ink.field")->setValue(0.6);
        find<QDoubleSpinBox>("look.contact.field")->setValue(0.5);
        QCOMPARE(mDocument->scene().look.shadeStrength, 0.4);
        QCOMPARE(mDocument->scene().look.inkLight, 0.6);
        QCOMPARE(mDocument->scene().look.contact, 0.5);
        QVERIFY(!find<QSlider>("look.rim_width")->isEnabled());
        find<QCheckBox>("look.rim_on")->click();
        find<QDoubleSpinBox>("look.rim_width.field")->setValue(12);
        QCOMPARE(mDocument->scene().rim->width, 12.0);
    }

    void everyControlSaysWhatItIsGoodFor()
    {
        const auto controls = mPanel->findChildren<QWidget*>();
        for (const QWidget* control : controls)
        {
            const bool isOurs = control->objectName().startsWith(QLatin1String("lampblack.panel.look.")) ||
                                control->objectName().startsWith(QLatin1String("lampblack.panel.light."));
            const bool isControl = qobject_cast<const QAbstractButton*>(control) != nullptr ||
                                   control->objectName().endsWith(QLatin1String(".row"));
            if (isOurs && isControl && qobject_cast<const Section*>(control->parentWidget()) == nullptr)
                QVERIFY2(!control->toolTip().isEmpty(), qPrintable(control->objectName()));
        }
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

    void progressStaysInSightAndCanBeCancelled()
    {
        QSignalSpy cancelled(mPanel->progress(), &JobProgress::cancelRequested);
        auto* cancel = find<QPushButton>("cancel");
        QVERIFY(!cancel->isVisible());
        mPanel->progress()->setProgress(QStringLiteral("Rendering"), 3, 8);
        QCOMPARE(find<QProgressBar>("progress")->value(), 3);
        QCOMPARE(find<QProgressBar>("progress")->text(), QStringLiteral("3 of 8"));
        mPanel->verticalScrollBar()->setValue(mPanel->verticalScrollBar()->maximum());
        QTRY_VERIFY(!cancel->visibleRegion().isEmpty());
        QTRY_VERIFY(mPanel->viewport()->y() >= cancel->mapTo(mPanel.get(), QPoint(0, cancel->height())).y());
        cancel->click();
        QCOMPARE(cancelled.count(), 1);
        mPanel->progress()->setProgress(QString(), 0, 0);
        QVERIFY(!cancel->isVisible());
    }

    void theButtonsRestWithTheirActions()
    {
        mRender->setEnabled(false);
        QVERIFY(!find<QPushButton>("render")->isEnabled());
        mRender->setEnabled(true);
        QSignalSpy triggered(mRender.get(), &QAction::triggered);
        find<QPushButton>("render")->click();
        QCOMPARE(triggered.count(), 1);
    }

    void sectionsStayAsTheyWereLeft()
    {
        find<QToolButton>("ambient_section")->click();
        find<QToolButton>("layers")->click();
        makePanel();
        const auto sections = mPanel->findChildren<Section*>();
        for (const Section* section : sections)
        {
            if (section->name().endsWith(QLatin1String("ambient_section")))
                QVERIFY(!section->isOpen());
            if (section->name().endsWith(QLatin1String("panel.layers")))
                QVERIFY(section->isOpen());
        }
    }

    void aLongLayerNameEndsInAnEllipsis()
    {
        const QString name = QStringLiteral("Bitmap Layer of the left arm");
        mHost->mLayers.prepend({name, Layer::Kind::Bitmap, true});
        Q_EMIT mHost->layersChanged();
        find<QToolButton>("layers")->click();
        auto* label = find<ElidedLabel>("layer_name.Bitmap Layer of the left arm");
        QTRY_VERIFY(label->width() > 0 && label->shownText().endsWith(QChar(0x2026)));
        QCOMPARE(label->toolTip(), name);
    }

    void fieldsHaveSensibleRangesAndShowWhatIsBeyond()
    {
        auto* power = find<QDoubleSpinBox>("power.field");
        auto* height = find<QDoubleSpinBox>("height.field");
        QVERIFY(power->maximum() <= 20);
        QVERIFY(height->minimum() >= -1000 && height->maximum() <= 1000);
        Scene scene = mDocument->scene();
        scene.lights[0].power = 60;
        scene.lights[0].z = -5000;
        mDocument->edit(QString(), scene);
        QCOMPARE(power->value(), 60.0);
        QCOMPARE(height->value(), -5000.0);
        QCOMPARE(light().z, -5000.0);
    }

    void theColourDialogLeavesTheDrawingInSight()
    {
        QMainWindow window;
        window.setCentralWidget(new QWidget);
        auto* dock = new QDockWidget;
        auto* inside = new QWidget;
        dock->setWidget(inside);
        dock->setMinimumWidth(200);
        window.addDockWidget(Qt::RightDockWidgetArea, dock);
        window.resize(900, 700);
        window.show();
        QVERIFY(QTest::qWaitForWindowExposed(&window));
        const QSize size(300, 250);
        const QRect dialog(placeBeside(size, *inside), size);
        const QWidget& canvas = *window.centralWidget();
        const QRect drawing(canvas.mapToGlobal(QPoint(150, 100)), canvas.size() - QSize(300, 200));
        QVERIFY(!dialog.intersects(drawing));
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
