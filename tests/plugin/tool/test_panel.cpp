// Panel and document agree, both ways, and neither echoes.
#include "support/panel_test.h"
#include "tool/panel/elided_label.h"

#include <QAbstractButton>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollBar>
#include <QSlider>
#include <QToolButton>

using namespace lampblack;

class PanelSectionsTest : public PanelTest
{
    Q_OBJECT

private Q_SLOTS:
    void fitsANarrowDock() { QVERIFY(mPanel->widget()->minimumSizeHint().width() <= 190); }

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

QTEST_MAIN(PanelSectionsTest)
#include "test_panel.moc"
