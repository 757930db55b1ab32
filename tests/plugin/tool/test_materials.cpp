// The dock of materials and the document.
#include "tool/materials/materials_dock.h"

#include <QtTest>

using namespace lampblack;

namespace
{

const QString Red = QStringLiteral("#dd3f2e");
const QString Blue = QStringLiteral("#3a5f8a");

} // namespace

class MaterialsTest : public QObject
{
    Q_OBJECT

private:
    SceneDocument mDocument;

    static QCheckBox* box(const MaterialsDock& dock, const char* kind, const QString& colour)
    {
        return dock.findChild<QCheckBox*>(QStringLiteral("lampblack.materials.") + QLatin1String(kind) +
                                          QLatin1Char('.') + colour);
    }

private Q_SLOTS:
    void init() { mDocument.reset(defaultScene(QSize(400, 300))); }

    void theMostUsedComesFirst()
    {
        MaterialsDock dock(mDocument);
        dock.resize(260, 400);
        dock.setPalette({{Blue, 900}, {Red, 100}});
        dock.show();
        const auto top = [&dock](const QString& colour)
        {
            return dock.findChild<QWidget*>(QStringLiteral("lampblack.materials.row.") + colour);
        };
        QTRY_VERIFY(top(Blue)->y() < top(Red)->y());
        dock.setPalette({{Red, 800}, {Blue, 700}});
        QTRY_VERIFY(top(Red)->y() < top(Blue)->y());
    }

    void boxesEditTheDocumentAndFollowIt()
    {
        MaterialsDock dock(mDocument);
        dock.setPalette({{Red, 100}, {Blue, 50}});
        box(dock, "glossy", Red)->click();
        QVERIFY(materialOf(mDocument.scene(), Red).glossy);
        QVERIFY(!materialOf(mDocument.scene(), Blue).glossy);
        QCOMPARE(mDocument.undoStack()->count(), 1);
        mDocument.undoStack()->undo();
        QVERIFY(!box(dock, "glossy", Red)->isChecked());
        box(dock, "diffuse", Blue)->click();
        QVERIFY(!materialOf(mDocument.scene(), Blue).diffuse);
    }

    void glossHasSlidersOnceItIsThere()
    {
        MaterialsDock dock(mDocument);
        dock.setPalette({{Red, 100}});
        const QString name = QStringLiteral("lampblack.materials.gloss.") + Red;
        QVERIFY(dock.findChild<QSlider*>(name) == nullptr);
        box(dock, "glossy", Red)->click();
        auto* gloss = dock.findChild<QSlider*>(name);
        QVERIFY(gloss != nullptr && gloss->isVisibleTo(&dock));
        gloss->setSliderDown(true);
        gloss->setSliderPosition(800);
        gloss->setSliderPosition(900);
        gloss->setSliderDown(false);
        QCOMPARE(materialOf(mDocument.scene(), Red).gloss, 0.9);
        QCOMPARE(mDocument.undoStack()->count(), 2);
        box(dock, "glossy", Red)->click();
        QVERIFY(!gloss->isVisibleTo(&dock));
    }

    void theArrowOpensLookLightAndVolume()
    {
        MaterialsDock dock(mDocument);
        dock.setPalette({{Red, 100}});
        const auto field = [&dock](const char* name)
        {
            return dock.findChild<QDoubleSpinBox*>(
                QStringLiteral("lampblack.materials.%1.%2.field").arg(QLatin1String(name), Red));
        };
        QVERIFY(field("volume") == nullptr);
        auto* arrow = dock.findChild<QToolButton*>(QStringLiteral("lampblack.materials.more.") + Red);
        arrow->click();
        field("volume")->setValue(1.5);
        field("nearer")->setValue(0.1);
        QCOMPARE(mDocument.scene().depth.colours.size(), 1);
        QCOMPARE(mDocument.scene().depth.colours[0].volume, 1.5);
        QCOMPARE(mDocument.scene().depth.colours[0].nearer, 0.1);
        field("emission")->setValue(2);
        QCOMPARE(materialOf(mDocument.scene(), Red).emission, 2.0);
        auto* look = dock.findChild<QComboBox*>(QStringLiteral("lampblack.materials.look.") + Red);
        Q_EMIT look->activated(int(LookChoice::Smooth));
        QCOMPARE(materialOf(mDocument.scene(), Red).look, LookChoice::Smooth);
        field("volume")->setValue(1);
        field("nearer")->setValue(0);
        QVERIFY2(mDocument.scene().depth.colours.isEmpty(), "what corrects nothing is not stored");
        arrow->click();
        QVERIFY(!field("volume")->isVisibleTo(&dock));
    }

    void coloursOfOtherFramesAreKept()
    {
        MaterialsDock dock(mDocument);
        dock.setPalette({{Red, 100}});
        box(dock, "glossy", Red)->click();
        dock.setPalette({{Blue, 100}});
        QVERIFY(materialOf(mDocument.scene(), Red).glossy);
        QVERIFY(box(dock, "glossy", Red) != nullptr);
        auto* otherSection = dock.findChild<Section*>();
        QVERIFY(otherSection->isVisibleTo(&dock) && !otherSection->isOpen());
        dock.revealColour(Red);
        QVERIFY(otherSection->isOpen());
        box(dock, "glossy", Red)->click(); // the default again: nothing to keep
        QVERIFY(!otherSection->isVisibleTo(&dock));
    }
};

QTEST_MAIN(MaterialsTest)
#include "test_materials.moc"
