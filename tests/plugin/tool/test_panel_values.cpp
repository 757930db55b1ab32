// Numbers, sliders and colours of the panel.
#include "support/panel_test.h"
#include "tool/panel/colour_button.h"
#include "tool/panel/value_row.h"

#include <QDoubleSpinBox>
#include <QScrollBar>
#include <QSlider>
#include <QWheelEvent>
#include <QtTest/qtestspontaneevent.h>

using namespace lampblack;

class PanelValuesTest : public PanelTest
{
    Q_OBJECT

private Q_SLOTS:
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

    void theProgramsColoursChooseInAnOpenDialog()
    {
        Q_EMIT mHost->colourChosen(QColor(10, 20, 30));
        QCOMPARE(light().colour, QColor(Qt::white));
        auto* button = find<ColourButton>("colour");
        button->click();
        Q_EMIT mHost->colourChosen(QColor(10, 20, 30, 40));
        QCOMPARE(light().colour, QColor(10, 20, 30));
        QCOMPARE(mDocument->scene().ambient.colour, QColor(Qt::white));
        button->findChild<QColorDialog*>()->reject();
        QCOMPARE(light().colour, QColor(Qt::white));
    }

    void theColourDialogClosesWithTheLampAndWithTheProject_data()
    {
        QTest::addColumn<bool>("isOtherProject");
        QTest::newRow("the lamp is put away") << false;
        QTest::newRow("another project") << true;
    }

    void theColourDialogClosesWithTheLampAndWithTheProject()
    {
        QFETCH(bool, isOtherProject);
        auto* button = find<ColourButton>("colour");
        button->click();
        Q_EMIT mHost->colourChosen(QColor(10, 20, 30));
        QVERIFY(button->findChild<QColorDialog*>() != nullptr);
        if (isOtherProject)
            Q_EMIT mHost->projectOpened({});
        else
            Q_EMIT mHost->toolActivated(false);
        QTRY_VERIFY(button->findChild<QColorDialog*>() == nullptr);
        QCOMPARE(light().colour, QColor(10, 20, 30));
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
};

QTEST_MAIN(PanelValuesTest)
#include "test_panel_values.moc"
