// Handles are at the places of their lights, have the same size at every zoom, and can be hit where they are
// painted.
#include "support/scenes.h"
#include "tool/canvas/handles.h"

#include <QtTest>

using namespace lampblack;

namespace
{

const QSize View(640, 480);

QTransform turnedView(double zoom, double degrees, bool flipped)
{
    QTransform view;
    view.translate(320, 240);
    view.rotate(degrees);
    view.scale(flipped ? -zoom : zoom, zoom);
    view.translate(-200, -150);
    return view;
}

} // namespace

class HandlesTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void stemsGoBothWaysThroughTheirDetent()
    {
        const double unit = 200;
        for (const double z : {-900.0, -200.0, -3.0, 3.0, 40.0, 200.0, 5000.0})
        {
            const double stem = stemOfHeight(z, unit);
            QVERIFY2((stem > 0) == (z > 0), qPrintable(QString::number(z)));
            QVERIFY(qAbs(heightOfStem(stem, unit) - z) < 1e-6 * qAbs(z));
        }
        QCOMPARE(heightOfStem(0, unit), 0.0);
        QVERIFY(stemOfHeight(400, unit) > stemOfHeight(200, unit));
    }

    void theLightIsHitUnderEveryView_data()
    {
        QTest::addColumn<double>("zoom");
        QTest::addColumn<double>("degrees");
        QTest::addColumn<bool>("flipped");
        QTest::newRow("plain") << 1.0 << 0.0 << false;
        QTest::newRow("33 %") << 0.33 << 0.0 << false;
        QTest::newRow("300 %") << 3.0 << 0.0 << false;
        QTest::newRow("turned") << 1.3 << 37.0 << false;
        QTest::newRow("turned and flipped") << 0.7 << 115.0 << true;
    }

    void theLightIsHitUnderEveryView()
    {
        QFETCH(double, zoom);
        QFETCH(double, degrees);
        QFETCH(bool, flipped);
        const QTransform view = turnedView(zoom, degrees, flipped);
        const Scene scene = sceneWithLight(210, 140, 200);
        const Handles handles(scene, 1, 0, view, View);
        const QPointF place = view.map(QPointF(210, 140));
        QCOMPARE(handles.lights()[0].centre, place);
        QCOMPARE(handles.lights()[0].ring, qMax(Handles::LeastRing, 50 * zoom));
        QCOMPARE(handles.at(place), (Handle{HandlePart::Light, 0}));
        // Twelve screen pixels are within reach at every zoom, thirty are not.
        QCOMPARE(handles.at(place + QPointF(12, 0)).part, HandlePart::Light);
        QVERIFY(handles.at(place + QPointF(30, 5)).part != HandlePart::Light);
        // Above on the screen is in front, however the canvas is turned.
        QCOMPARE(handles.at(place - QPointF(0, stemOfHeight(200, 200))), (Handle{HandlePart::Height, 0}));
        QCOMPARE(handles.at(place + QPointF(handles.lights()[0].ring, 0)).part, HandlePart::Size);
    }

    void aLightBehindThePaperHangsBelow()
    {
        const Handles handles(sceneWithLight(100, 100, -200), 1, 0, QTransform(), View);
        QVERIFY(handles.lights()[0].behind);
        QVERIFY(handles.lights()[0].grip.y() > 100);
    }

    void onlyTheSelectedLightOffersItsRing()
    {
        const Scene scene = sceneWithLight(200, 150, 200);
        QCOMPARE(Handles(scene, 1, 0, QTransform(), View).at({250, 150}).part, HandlePart::Size);
        QCOMPARE(Handles(scene, 1, -1, QTransform(), View).at({250, 150}).part, HandlePart::None);
    }

    void aLightOutOfViewIsWithinReachAtTheEdge()
    {
        const Handles handles(sceneWithLight(5000, -700, 200), 1, 0, QTransform(), View);
        QVERIFY(handles.lights()[0].outside);
        QVERIFY(QRectF(QPointF(), View).contains(handles.lights()[0].centre));
        QCOMPARE(handles.at(handles.lights()[0].centre), (Handle{HandlePart::Light, 0}));
    }

    void theFloorFollowsThePitchAndTheView()
    {
        Scene scene = sceneWithLight(100, 50, 200);
        scene.floor = Floor();
        scene.floor->y = 240;
        const auto depth = [&scene](double pitch)
        {
            scene.floor->pitch = pitch;
            const Handles handles(scene, 1, -1, QTransform(), View);
            const FloorShape floor = handles.floor().value_or(FloorShape());
            return floor.patch[2].y() - floor.patch[1].y();
        };
        QVERIFY(depth(80) > 2 * depth(20));
        const Handles flipped(scene, 1, -1, turnedView(1, 180, false), View);
        QVERIFY(flipped.floor()->patch[2].y() < flipped.floor()->grip.y());
        QCOMPARE(flipped.at(flipped.floor()->line.center()), (Handle{HandlePart::Floor, -1}));
    }

    void theRegionHoldsAllThatIsPainted()
    {
        Scene scene = sceneWithLight(200, 150, 200);
        scene.lights[0].size = 260;
        const Handles handles(scene, 1, 0, QTransform(), View);
        QVERIFY(handles.region().contains(QPoint(330, 150)));
        QVERIFY(handles.region().contains(handles.lights()[0].grip.toPoint()));
        QVERIFY2(!handles.region().contains(QPoint(260, 190)), "a ring repaints what it encloses");
    }
};

QTEST_MAIN(HandlesTest)
#include "test_handles.moc"
