// Cuts: which are shown, which is under the pointer, and what a correction makes of the scene.
#include "support/scenes.h"
#include "tool/depth/cut_painter.h"
#include "tool/depth/hint_edit.h"

#include <QtMath>
#include <QtTest>

using namespace lampblack;

namespace
{

QPolygonF lineOf(const QVector<QPointF>& points)
{
    return QPolygonF(points);
}

Overlap overlap(const QPolygonF& line, FrontSide front = FrontSide::Left, bool hinted = false)
{
    Overlap found;
    for (const QPointF& point : line)
        found.points.append({point.x(), point.y()});
    found.front = front;
    found.amount = 12;
    found.hinted = hinted;
    return found;
}

const QPolygonF Arm = lineOf({{100, 50}, {150, 60}, {200, 50}});
const QPolygonF Chin = lineOf({{50, 200}, {120, 220}});

} // namespace

class CutsTest : public QObject
{
    Q_OBJECT

private:
    Scene mScene = sceneWithLight(200, 150, 200); // 400 x 300 pixels

private Q_SLOTS:
    void whatWasFoundIsShown()
    {
        const QVector<Cut> cuts =
            cutsAt(mScene, 3, {overlap(Arm), overlap(Chin, FrontSide::Right), overlap(lineOf({}))});
        QCOMPARE(cuts.size(), 2);
        QCOMPARE(cuts[0].line, Arm);
        QCOMPARE(cuts[1].front, FrontSide::Right);
        QCOMPARE(cuts[0].amount, 12.0);
        QVERIFY(!cuts[0].isCorrected && cuts[0].hint < 0);
    }

    void aHintStandsForWhatItIsAbout()
    {
        const Cut arm = cutsAt(mScene, 3, {overlap(Arm)}).first();
        const Scene flipped = withFront(mScene, 3, arm, FrontSide::Right);
        // As the worker finds it again: elsewhere along the line, a little beside it, from its other end.
        const QPolygonF again = lineOf({{199, 52}, {170, 57}, {140, 59}});
        const QVector<Overlap> found{overlap(Chin), overlap(again, FrontSide::Left, true)};
        const QVector<Cut> cuts = cutsAt(flipped, 3, found);
        QCOMPARE(cuts.size(), 2);
        QCOMPARE(cuts[0].line, Arm);
        QCOMPARE(cuts[0].front, FrontSide::Right);
        QCOMPARE(cuts[0].hint, 0);
        QCOMPARE(cuts[0].amount, 12.0);
        QCOMPARE(cuts[1].line, Chin);
        // In another frame it is what the worker made of it.
        const QVector<Cut> next = cutsAt(flipped, 4, found);
        QCOMPARE(next.size(), 2);
        QVERIFY(next[1].isCorrected && next[1].hint < 0);
    }

    void theNearestCutIsUnderThePointer()
    {
        const QVector<Cut> cuts = cutsAt(mScene, 1, {overlap(Arm), overlap(lineOf({{100, 70}, {200, 70}}))});
        const QTransform twice = QTransform::fromScale(2, 2);
        QCOMPARE(cutUnder(cuts, twice, {300, 118}, 8), 0);
        QCOMPARE(cutUnder(cuts, twice, {300, 135}, 8), 1);
        QCOMPARE(cutUnder(cuts, twice, {300, 100}, 8), -1);
        QCOMPARE(cutUnder(cuts, twice, {180, 100}, 8), -1); // past its end
        QVERIFY(qAbs(distanceTo(Arm, {80, 50}) - 20) < 1e-9);
    }

    void aLongLineKeepsItsShape()
    {
        QPolygonF circle;
        for (int i = 0; i <= 200; ++i)
            circle.append({100 * qCos(i * M_PI / 100), 100 * qSin(i * M_PI / 100)});
        const QPolygonF few = simplified(circle, MaxHintPoints);
        QCOMPARE(few.size(), MaxHintPoints);
        QCOMPARE(few.first(), circle.first());
        QCOMPARE(few.last(), circle.last());
        for (const QPointF& point : circle)
            QVERIFY(distanceTo(few, point) < 8);
        QCOMPARE(simplified(lineOf({{0, 0}, {5, 0}, {10, 0}}), 16).size(), 2);
    }

    void aCorrectionIsWrittenOnceAndThenChanged()
    {
        const Cut arm = cutsAt(mScene, 3, {overlap(Arm)}).first();
        const Scene flipped = withFront(mScene, 3, arm, otherSide(arm.front));
        QCOMPARE(flipped.depth.hints.size(), 1);
        const DepthHint hint = flipped.depth.hints[0];
        QCOMPARE(hint.frame, 3);
        QCOMPARE(hint.front, FrontSide::Right);
        QCOMPARE(hint.amount, 0.0); // the worker's own least amount
        QCOMPARE(hint.points.size(), 3);
        const Scene joined = withFront(flipped, 3, cutsAt(flipped, 3, {})[0], FrontSide::Joined);
        QCOMPARE(joined.depth.hints.size(), 1);
        QCOMPARE(joined.depth.hints[0].front, FrontSide::Joined);
        QCOMPARE(otherSide(FrontSide::Joined), FrontSide::Left);
        QCOMPARE(withoutHint(joined, cutsAt(joined, 3, {})[0]), mScene);
        QCOMPARE(withoutHint(joined, arm), joined);
    }

    void stepsGrowAndShrinkFromWhatTheyAre()
    {
        const Cut arm = cutsAt(mScene, 3, {overlap(Arm)}).first();
        QCOMPARE(furtherApart(mScene, arm, 240), 2.0 * 12 / 240);
        const Scene apart = withAmount(mScene, 3, arm, furtherApart(mScene, arm, 240));
        QCOMPARE(apart.depth.hints[0].front, arm.front);
        const Cut corrected = cutsAt(apart, 3, {})[0];
        QCOMPARE(furtherApart(apart, corrected, 240), 3.0 * 12 / 240);
        QCOMPARE(nearerTogether(apart, corrected, 240), 2.0 * 12 / 240 / 1.5);
        Scene largest = withAmount(apart, 3, corrected, 0.9);
        QCOMPARE(furtherApart(largest, corrected, 240), 1.0);
        largest = withAmount(apart, 3, corrected, 0.006);
        QVERIFY(nearerTogether(largest, corrected, 240) > 0);
    }

    void correctionsAreRemovedByFrame()
    {
        const Cut arm = cutsAt(mScene, 3, {overlap(Arm)}).first();
        const Cut chin = cutsAt(mScene, 3, {overlap(Chin)}).first();
        Scene scene = withFront(withFront(mScene, 3, arm, FrontSide::Right), 4, chin, FrontSide::Joined);
        QCOMPARE(withoutHints(scene, 3).depth.hints.size(), 1);
        QCOMPARE(withoutHints(scene, 3).depth.hints[0].frame, 4);
        QCOMPARE(withoutHints(scene), mScene);
    }

    void theSchemaHasRoomForSoMany()
    {
        Scene scene = mScene;
        for (int i = 0; i < MaxHints; ++i)
            scene = withFront(scene, i, {Arm, FrontSide::Left, 0, false, -1}, FrontSide::Right);
        QCOMPARE(scene.depth.hints.size(), MaxHints);
        QCOMPARE(clamped(scene), scene);
        const Cut another{Chin, FrontSide::Left, 0, false, -1};
        QVERIFY(!canCorrect(scene, another));
        QCOMPARE(withFront(scene, 5, another, FrontSide::Right), scene);
        QVERIFY(canCorrect(scene, cutsAt(scene, 5, {})[0]));
        Scene tooMany = scene;
        tooMany.depth.hints.append(scene.depth.hints[0]);
        QCOMPARE(clamped(tooMany), scene);
    }

    void teethStandOnTheSideInFront_data()
    {
        QTest::addColumn<QTransform>("view");
        QTest::newRow("as drawn") << QTransform();
        QTest::newRow("mirrored") << QTransform(-2, 0, 0, 2, 800, 0);
        QTest::newRow("turned") << QTransform().rotate(70);
    }

    void teethStandOnTheSideInFront()
    {
        QFETCH(QTransform, view);
        const QPolygonF east = lineOf({{100, 100}, {200, 100}}); // its left side is up
        for (const FrontSide front : {FrontSide::Left, FrontSide::Right})
        {
            const QVector<QPolygonF> teeth = teethOf({east, front, 0, false, -1}, view, 20);
            QVERIFY(teeth.size() >= 4);
            for (const QPolygonF& tooth : teeth)
            {
                const QPointF tip = view.inverted().map(tooth.last());
                QCOMPARE(tip.y() < 100, front == FrontSide::Left);
            }
        }
        QVERIFY(teethOf({east, FrontSide::Joined, 0, true, -1}, view, 20).isEmpty());
        QCOMPARE(teethOf({lineOf({{0, 0}, {3, 0}}), FrontSide::Left, 0, false, -1}, view, 20).size(), 1);
    }

    void theCharacterIsAsLongAsItsLongerSide()
    {
        QImage image(50, 80, QImage::Format_RGBA8888);
        image.fill(Qt::transparent);
        QCOMPARE(longerSideOf(image), 1);
        image.setPixelColor(10, 20, Qt::red);
        image.setPixelColor(20, 59, QColor(0, 0, 0, 3));
        QCOMPARE(longerSideOf(image), 40);
    }
};

QTEST_APPLESS_MAIN(CutsTest)
#include "test_cuts.moc"
