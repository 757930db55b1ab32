// The instant shading follows the laws of light, and the shape behind it its closed form.
#include "scene/scene.h"
#include "support/scenes.h"
#include "tool/canvas/instant_shading.h"

#include <QPainter>
#include <QtTest>

#include <cmath>

using namespace lampblack;

namespace
{

const QSize Size(400, 300);
const QPointF Middle(200, 150);
constexpr double Radius = 120;

QImage blank()
{
    QImage image(Size, QImage::Format_RGBA8888);
    image.fill(Qt::transparent);
    return image;
}

QImage disc(const QColor& colour = QColor(128, 128, 128))
{
    QImage image = blank();
    QPainter painter(&image);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    painter.drawEllipse(Middle, Radius, Radius);
    return image;
}

Scene dark(double x, double y, double z, double power = 1)
{
    Scene scene = sceneWithLight(x, y, z);
    scene.ambient.strength = 0;
    scene.lights[0].power = power;
    return scene;
}

int elementAt(const InstantShape& shape, double x, double y)
{
    return int(y / shape.step) * shape.size.width() + int(x / shape.step);
}

/// Linear light on the drawing at a place.
double lightAt(const Scene& scene, double x, double y, const QTransform& camera = {})
{
    const InstantShape shape = inflateFigure(disc());
    return std::pow(lightOn(shape, scene, camera).red[elementAt(shape, x, y)], 2.2);
}

QImage shaded(const QImage& drawing, const Scene& scene)
{
    const InstantShape shape = inflateFigure(drawing);
    return shadedDrawing(drawing, shape, lightOn(shape, scene, {}), {}, scene);
}

/// A light on the left, and a white rim.
Scene rimmed(double width, double away)
{
    Scene scene = dark(20, 150, 200);
    scene.rim = Rim{width, Qt::white, 1, away, {}};
    return scene;
}

} // namespace

class InstantShadingTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void discBecomesHalfABall()
    {
        const InstantShape shape = inflateFigure(disc());
        QVERIFY(!shape.isEmpty());
        for (const double angle : {0.0, 1.0, 2.5, 4.4})
        {
            for (const double share : {0.0, 0.3, 0.6, 0.85})
            {
                const double x = share * Radius * std::cos(angle);
                const double y = share * Radius * std::sin(angle);
                const int at = elementAt(shape, Middle.x() + x, Middle.y() + y);
                const double depth = std::sqrt(1 - share * share);
                QVERIFY(std::abs(shape.height[at] - depth * Radius) < 0.06 * Radius);
                QVERIFY(std::abs(shape.nx[at] - x / Radius) < 0.06);
                QVERIFY(std::abs(shape.ny[at] - y / Radius) < 0.06);
                QVERIFY(std::abs(shape.nz[at] - depth) < 0.06);
            }
        }
    }

    void realNormalsTakeThePlaceOfTheGuess()
    {
        InstantShape shape = inflateFigure(disc());
        const InstantShape guess = shape;
        // The left half faces right and up.
        QImage picture(40, 30, QImage::Format_RGBA8888_Premultiplied);
        picture.fill(Qt::transparent);
        const auto channel = [](double component)
        {
            return int(std::lround((component + 1) * 127.5));
        };
        QPainter(&picture).fillRect(0, 0, 20, 30, QColor(channel(0.6), channel(0.64), channel(0.48)));
        takeNormals(shape, picture);
        const int left = elementAt(shape, Middle.x() - 50, Middle.y());
        const int right = elementAt(shape, Middle.x() + 50, Middle.y());
        QVERIFY(std::abs(shape.nx[left] - 0.6F) < 0.01F);
        QVERIFY2(std::abs(shape.ny[left] + 0.64F) < 0.01F, "y points down");
        QVERIFY(std::abs(shape.nz[left] - 0.48F) < 0.01F);
        QCOMPARE(shape.nx[right], guess.nx[right]);
        QCOMPARE(shape.height, guess.height);
    }

    void sideTowardsTheLightIsBrighter()
    {
        const Scene fromLeft = dark(20, 150, 200);
        QVERIFY(lightAt(fromLeft, 120, 150) > 2 * lightAt(fromLeft, 280, 150));
        const Scene fromAbove = dark(200, 0, 200);
        QVERIFY(lightAt(fromAbove, 200, 70) > 2 * lightAt(fromAbove, 200, 230));
    }

    void lightIsLinearInPowerAndAdds()
    {
        // Below the roll-off.
        const double one = lightAt(dark(20, 150, 200, 0.1), 150, 150);
        QVERIFY(std::abs(lightAt(dark(20, 150, 200, 0.3), 150, 150) - 3 * one) < 0.02 * one);
        Scene both = dark(20, 150, 200, 0.1);
        both.lights.append(dark(380, 150, 200, 0.1).lights[0]);
        const double other = lightAt(dark(380, 150, 200, 0.1), 150, 150);
        QVERIFY(std::abs(lightAt(both, 150, 150) - one - other) < 0.02 * one);
        both.ambient.strength = 0.1;
        QVERIFY(std::abs(lightAt(both, 150, 150) - one - other - 0.1) < 0.02 * one);
    }

    void farLampFallsOffWithTheSquareOfItsDistance()
    {
        const double near = lightAt(dark(200, 150, 2000, 1), 200, 150) / 1;
        const double far = lightAt(dark(200, 150, 4000, 1), 200, 150);
        const double nearest = 2000 - Radius;
        const double farthest = 4000 - Radius;
        QVERIFY(std::abs(near / far * nearest * nearest / farthest / farthest - 1) < 0.02);
    }

    void ambientAloneIsEvenAndLampsThatAreOffAreDark()
    {
        Scene scene = dark(20, 150, 200);
        scene.ambient.strength = 0.4;
        scene.lights[0].on = false;
        for (const double x : {100.0, 200.0, 300.0})
            QVERIFY(std::abs(lightAt(scene, x, 150) - 0.4) < 0.01);
        scene.lights[0].on = true;
        scene.lights.append(dark(380, 150, 200, 0.2).lights[0]);
        const double both = lightAt(scene, 150, 150);
        scene.lights[1].solo = true;
        QVERIFY(lightAt(scene, 150, 150) < both - 0.05);
    }

    void sunHasNoFalloff()
    {
        Scene scene = dark(20, 150, 200, 0.3);
        scene.lights[0].kind = LightKind::Sun;
        const double near = lightAt(scene, 200, 150);
        scene.lights[0].x = 200 - 10 * 180;
        scene.lights[0].z = 10 * 200;
        scene.lights[0].size *= 10;
        QVERIFY(std::abs(lightAt(scene, 200, 150) - near) < 0.01 * near);
    }

    void lightBehindThePaperShinesOnTheRimOnly()
    {
        const Scene scene = dark(20, 150, -200);
        QVERIFY(lightAt(scene, 200, 150) < 0.001);
        QVERIFY(lightAt(scene, 82, 150) > 0.05);
    }

    void colourOfTheLightTintsTheDrawing()
    {
        Scene scene = dark(200, 150, 200);
        scene.lights[0].colour = Qt::red;
        const QRgb middle = shaded(disc(), scene).pixel(200, 150);
        QVERIFY(qRed(middle) > 100);
        QCOMPARE(qGreen(middle), 0);
    }

    void cameraMovesTheLightWithTheDrawing()
    {
        // The camera has zoomed to half: the disc of 120 pixels is one of 240 on the canvas.
        const double close = lightAt(dark(20, 150, 200, 0.3), 120, 150);
        const double zoomed = lightAt(
            [&]
            {
                Scene scene = dark(40, 300, 400, 0.3);
                scene.canvas = {800, 600};
                scene.lights[0].size = 200;
                return scene;
            }(),
            120, 150, QTransform::fromScale(0.5, 0.5));
        QVERIFY(std::abs(zoomed - close) < 0.01 * close);
    }

    void lookWithTonesHasFlatTones()
    {
        Scene scene = sceneWithLight(20, 150, 200);
        scene.lights[0].power = 0.7;
        scene.look.tones = {0.45};
        scene.look.softness = 0;
        const QImage picture = shaded(disc(), scene);
        QSet<QRgb> tones;
        for (int x = 90; x < 310; ++x)
            tones.insert(picture.pixel(x, 150));
        QVERIFY2(tones.size() <= 4, qPrintable(QString::number(tones.size())));
        QVERIFY(qRed(picture.pixel(110, 150)) > qRed(picture.pixel(290, 150)) + 20);
        QCOMPARE(picture.pixel(280, 150), picture.pixel(290, 150));
    }

    void coloursHaveALookOfTheirOwn()
    {
        Scene scene = sceneWithLight(20, 150, 200);
        scene.lights[0].power = 0.7;
        Material material;
        material.look = LookChoice::Cel;
        scene.materials.insert(QStringLiteral("#808080"), material);
        const QImage toned = shaded(disc(), scene);
        QCOMPARE(toned.pixel(280, 150), toned.pixel(290, 150));
        QVERIFY(qRed(toned.pixel(110, 150)) > qRed(toned.pixel(290, 150)) + 20);
        scene.look.tones = {0.45};
        scene.materials[QStringLiteral("#808080")].look = LookChoice::Smooth;
        const QImage smooth = shaded(disc(), scene);
        scene.look.tones.clear();
        scene.materials.clear();
        QCOMPARE(smooth, shaded(disc(), scene));
    }

    void rimIsABandAlongTheSilhouette()
    {
        Scene scene = rimmed(20, 0);
        const InstantRim rim(scene, edgesOf(disc()), {});
        for (const double angle : {0.0, 1.0, 2.5, 4.4})
        {
            const auto shareAt = [&](double distance)
            {
                const double away = Radius - distance;
                return rim.shareAt(Middle.x() + away * std::cos(angle), Middle.y() + away * std::sin(angle));
            };
            QVERIFY(shareAt(3) > 0.99F);
            QVERIFY(shareAt(14) > 0.95F);
            QVERIFY(std::abs(shareAt(20) - 0.5F) < 0.35F);
            QVERIFY(shareAt(27) == 0);
            QVERIFY(shareAt(Radius) == 0);
        }
        scene.rim.reset();
        QVERIFY(InstantRim(scene, edgesOf(disc()), {}).shareAt(82, 150) == 0);
    }

    void rimIsLeftOutWhereItFacesTheLight()
    {
        const InstantRim rim(rimmed(20, 1), edgesOf(disc()), {});
        QVERIFY2(rim.shareAt(88, 150) < 0.05F, "towards the light");
        QVERIFY2(rim.shareAt(312, 150) > 0.95F, "away from it");
    }

    void rimBeginsInsideTheOutline()
    {
        QImage outlined = disc();
        QPainter painter(&outlined);
        painter.setPen(QPen(Qt::black, 12));
        painter.drawEllipse(Middle, Radius, Radius);
        painter.end();
        const Scene scene = rimmed(10, 0);
        const InstantRim rim(scene, edgesOf(outlined), {});
        QVERIFY(rim.shareAt(Middle.x() + Radius - 10, Middle.y()) > 0.9F);
        QVERIFY(rim.shareAt(Middle.x() + Radius - 22, Middle.y()) == 0);
        const InstantShape shape = inflateFigure(outlined);
        const QImage picture = shadedDrawing(outlined, shape, lightOn(shape, scene, {}), rim, scene);
        QVERIFY2(qRed(picture.pixel(320, 150)) < 5, "the line stays dark");
        QVERIFY2(qRed(picture.pixel(310, 150)) > qRed(picture.pixel(290, 150)) + 60, "the paint beside it");
    }

    void rimFollowsThePartInFront()
    {
        // The left half of the disc is in front of the right one.
        const InnerEdge edge{QPolygonF(QVector<QPointF>{{200, 60}, {200, 150}, {200, 240}}), false};
        for (const InnerEdge& same :
             {edge, InnerEdge{QPolygonF(QVector<QPointF>{{200, 240}, {200, 60}}), true}})
        {
            const InstantRim rim(rimmed(12, 0), edgesOf(disc(), {same}), {});
            QVERIFY2(rim.shareAt(195, 150) > 0.95F, "beside the line");
            QVERIFY2(rim.shareAt(180, 150) < 0.05F, "further inside");
            QVERIFY2(rim.shareAt(206, 150) < 0.05F, "behind it");
            QVERIFY2(rim.shareAt(195, 255) < 0.05F, "past its end");
        }
        const InstantRim without(rimmed(12, 0), edgesOf(disc()), {});
        QVERIFY(without.shareAt(195, 150) == 0);
    }

    void rimGoesRoundACornerOfThePartInFront()
    {
        const QPolygonF corner(QVector<QPointF>{{120, 150}, {200, 150}, {200, 230}});
        const InstantRim inside(rimmed(12, 0), edgesOf(disc(), {{corner, false}}), {});
        const InstantRim outside(rimmed(12, 0), edgesOf(disc(), {{corner, true}}), {});
        QVERIFY(inside.shareAt(193, 157) > 0.9F);
        QVERIFY(inside.shareAt(204, 146) < 0.05F);
        QVERIFY(outside.shareAt(204, 146) > 0.9F);
        QVERIFY(outside.shareAt(215, 135) < 0.05F);
        QVERIFY(outside.shareAt(190, 160) < 0.05F);
    }

    void rimMovesWithTheCamera()
    {
        Scene scene = rimmed(40, 1);
        scene.lights[0].x = 40;
        scene.lights[0].y = 300;
        const InstantRim zoomed(scene, edgesOf(disc()), QTransform::fromScale(0.5, 0.5));
        const InstantRim close(rimmed(20, 1), edgesOf(disc()), {});
        for (const double x : {88.0, 200.0, 300.0, 312.0})
            QVERIFY(std::abs(zoomed.shareAt(x, 150) - close.shareAt(x, 150)) < 0.01F);
    }

    void paperAroundTheFigureIsBare()
    {
        const QImage picture = shaded(disc(), dark(20, 150, 200));
        QCOMPARE(picture.size(), Size);
        QCOMPARE(qAlpha(picture.pixel(20, 20)), 0);
        QCOMPARE(qAlpha(picture.pixel(200, 150)), 255);
    }

    void paperThatLinesEncloseIsLitAsWhite()
    {
        QImage ring = blank();
        QPainter painter(&ring);
        painter.setPen(QPen(Qt::black, 6));
        painter.drawEllipse(Middle, Radius, Radius);
        painter.end();
        const QImage picture = shaded(ring, dark(20, 150, 200));
        const auto shownAt = [&](int x, int y)
        {
            return 255 - qAlpha(picture.pixel(x, y)) + qRed(picture.pixel(x, y));
        };
        QCOMPARE(shownAt(20, 20), 255);
        QVERIFY(shownAt(300, 150) < 100);
        QVERIFY(shownAt(120, 150) > shownAt(280, 150) + 50);
    }

    void paintedGroundIsNotLit()
    {
        QImage painted = disc(QColor(60, 120, 60));
        QImage whole(Size, QImage::Format_RGBA8888);
        whole.fill(QColor(200, 220, 240));
        QPainter painter(&whole);
        painter.drawImage(0, 0, painted);
        painter.end();
        const QImage picture = shaded(whole, dark(20, 150, 200));
        QCOMPARE(QColor(picture.pixel(20, 20)), QColor(200, 220, 240));
        QVERIFY(qGreen(picture.pixel(300, 150)) < 60);
    }

    void coloursWithoutMaterialStayAsDrawn()
    {
        Scene scene = dark(20, 150, 200);
        scene.materials.insert(QStringLiteral("#808080"), Material{false, false, 0.5, 0.3, {}});
        QCOMPARE(QColor(shaded(disc(), scene).pixel(280, 150)), QColor(128, 128, 128));
    }

    void largeDrawingsMakeSmallPictures()
    {
        const QImage large = disc().scaled(4000, 3000);
        const InstantShape shape = inflateFigure(large);
        QVERIFY(shape.count() < 160 * 130);
        const QImage picture =
            shadedDrawing(large, shape, lightOn(shape, dark(20, 150, 200), {}), {}, Scene());
        QCOMPARE(picture.size(), QSize(1024, 768));
    }

    void thereIsNothingToLightOnAnEmptyPage()
    {
        QVERIFY(inflateFigure(blank()).isEmpty());
        QVERIFY(inflateFigure(QImage()).isEmpty());
    }

    void shading_data()
    {
        QTest::addColumn<QSize>("size");
        QTest::newRow("the example") << QSize(640, 720);
        QTest::newRow("large") << QSize(1000, 1000);
        QTest::newRow("HD") << QSize(1920, 1080);
    }

    void shading()
    {
        QFETCH(QSize, size);
        const QImage large = disc().scaled(size);
        Scene scene = defaultScene(size);
        scene.rim = Rim{12, Qt::white, 1, 0.5, {}};
        QVector<InnerEdge> inner;
        for (int i = 0; i < 20; ++i)
        {
            InnerEdge edge;
            for (int j = 0; j < 32; ++j)
                edge.line.append(QPointF(size.width() * (0.3 + 0.01 * j), size.height() * (0.3 + 0.02 * i)));
            inner.append(edge);
        }
        QBENCHMARK
        {
            const InstantShape shape = inflateFigure(large);
            const InstantRim rim(scene, edgesOf(large, inner), {});
            shadedDrawing(large, shape, lightOn(shape, scene, {}), rim, scene);
        }
    }
};

QTEST_GUILESS_MAIN(InstantShadingTest)
#include "test_instant_shading.moc"
