// The look in the panel.
#include "support/panel_test.h"

#include "tool/panel/colour_button.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QSlider>
#include <QToolButton>

using namespace lampblack;

class PanelLookTest : public PanelTest
{
    Q_OBJECT

private Q_SLOTS:
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

    void castShadowsHaveATone()
    {
        auto* colour = find<ColourButton>("look.cast_colour");
        auto* strength = find<QDoubleSpinBox>("look.cast.field");
        QVERIFY2(!colour->isEnabled() && !strength->isEnabled(), "smooth light has no cast tone");
        QTest::mouseClick(find<QToolButton>("look.hard-cel"), Qt::LeftButton);
        const Scene before = mDocument->scene();
        QVERIFY(colour->isEnabled());
        strength->setValue(0.7);
        Q_EMIT colour->edited(QColor(0x10, 0x20, 0x40), 0);
        QCOMPARE(mDocument->scene().look.castStrength, 0.7);
        QCOMPARE(mDocument->scene().look.castColour, QColor(0x10, 0x20, 0x40));
        QCOMPARE(colour->colour(), QColor(0x10, 0x20, 0x40));
        mDocument->undoStack()->undo();
        mDocument->undoStack()->undo();
        QVERIFY(mDocument->scene() == before);
        QCOMPARE(strength->value(), before.look.castStrength);
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
};

QTEST_MAIN(PanelLookTest)
#include "test_panel_look.moc"
