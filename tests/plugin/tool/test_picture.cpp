// The lit picture lands on the drawing's own pixels under every view.
#include "support/fake_host.h"
#include "support/scenes.h"
#include "tool/canvas/canvas_overlay.h"
#include "tool/canvas/lit_picture.h"

#include <cmath>

using namespace lampblack;

namespace
{

const QSize View(640, 480);
const QSize CanvasSize(400, 300);
const QRect Mark(260, 90, 12, 12); // canvas pixels; off every axis of symmetry

PreviewImage imageOf(const QRectF& crop, double pixelsPerCanvasPixel)
{
    PreviewImage image;
    image.crop = crop;
    image.picture =
        QImage((crop.size() * pixelsPerCanvasPixel).toSize(), QImage::Format_RGBA8888_Premultiplied);
    image.picture.fill(QColor(40, 80, 160));
    QPainter painter(&image.picture);
    painter.scale(pixelsPerCanvasPixel, pixelsPerCanvasPixel);
    painter.translate(-crop.topLeft());
    painter.fillRect(Mark, QColor(255, 0, 0));
    return image;
}

/// Centre of the red mark in logical pixels, weighted by how red a pixel is.
QPointF centreOfMark(const QImage& shown, double pixelRatio)
{
    double weight = 0;
    QPointF sum;
    for (int y = 0; y < shown.height(); ++y)
    {
        for (int x = 0; x < shown.width(); ++x)
        {
            const QRgb pixel = shown.pixel(x, y);
            const double red = qMax(0, qRed(pixel) - qMax(qGreen(pixel), qBlue(pixel)));
            weight += red;
            sum += red * QPointF(x + 0.5, y + 0.5);
        }
    }
    return weight > 0 ? sum / weight / pixelRatio : QPointF(-1, -1);
}

QImage shownBy(LitPicture& picture, const QTransform& view, double pixelRatio)
{
    QImage shown((QSizeF(View) * pixelRatio).toSize(), QImage::Format_ARGB32_Premultiplied);
    shown.setDevicePixelRatio(pixelRatio);
    shown.fill(Qt::transparent);
    QPainter painter(&shown);
    picture.paint(painter, view, View, pixelRatio, Qt::white);
    return shown;
}

} // namespace

class PictureTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void theMarkLandsOnItsPixel_data()
    {
        QTest::addColumn<QTransform>("view");
        QTest::addColumn<double>("pixelRatio");
        QTest::addColumn<double>("density");
        QTest::newRow("plain") << QTransform() << 1.0 << 1.0;
        QTest::newRow("shifted by parts of a pixel") << QTransform::fromTranslate(10.4, 20.7) << 1.0 << 1.0;
        QTest::newRow("33 %") << QTransform(0.33, 0, 0, 0.33, 50, 60) << 1.0 << 0.33;
        QTest::newRow("33 %, from more") << QTransform(0.33, 0, 0, 0.33, 50, 60) << 1.0 << 1.0;
        QTest::newRow("300 %") << QTransform(3, 0, 0, 3, -600, -100) << 1.0 << 3.0;
        QTest::newRow("300 %, from less") << QTransform(3, 0, 0, 3, -600, -100) << 1.0 << 0.5;
        QTest::newRow("turned") << QTransform().translate(200, 20).rotate(33) << 1.0 << 1.0;
        QTest::newRow("flipped") << QTransform(-1, 0, 0, 1, 420, 30) << 1.0 << 1.0;
        QTest::newRow("flipped, turned, 70 %")
            << QTransform().translate(300, 380).rotate(190).scale(-0.7, 0.7) << 1.0 << 0.7;
        QTest::newRow("a dense screen") << QTransform(1, 0, 0, 1, 30, 40) << 2.0 << 2.0;
        QTest::newRow("a dense screen, turned") << QTransform().translate(200, 20).rotate(33) << 2.0 << 1.0;
    }

    void theMarkLandsOnItsPixel()
    {
        QFETCH(QTransform, view);
        QFETCH(double, pixelRatio);
        QFETCH(double, density);
        LitPicture picture;
        picture.setPicture(imageOf(QRectF(QPointF(), QSizeF(CanvasSize)), density), QTransform());
        const QImage shown = shownBy(picture, view, pixelRatio);
        const QPointF expected = view.map(QRectF(Mark).center());
        const QPointF found = centreOfMark(shown, pixelRatio);
        const double off = QLineF(expected, found).length();
        QVERIFY2(off < 0.5, qPrintable(QStringLiteral("off by %1 pixels").arg(off)));
    }

    void aCropOfAMovedCameraLandsToo()
    {
        // The camera has moved by (30, -20) and the crop starts at a fraction of a pixel.
        const QTransform canvasToImage = QTransform::fromTranslate(30, -20);
        PreviewImage image = imageOf(QRectF(200.5, 40.25, 120, 100), 2);
        LitPicture picture;
        picture.setPicture(image, canvasToImage);
        const QTransform view(1.5, 0, 0, 1.5, -40, 12);
        const QPointF expected = view.map(canvasToImage.inverted().map(QRectF(Mark).center()));
        const QPointF found = centreOfMark(shownBy(picture, view, 1), 1);
        QVERIFY(QLineF(expected, found).length() < 0.5);
    }

    void onlyTheCropIsCovered()
    {
        LitPicture picture;
        picture.setPicture(imageOf(QRectF(100, 50, 200, 100), 1), QTransform());
        const QImage shown = shownBy(picture, QTransform(), 1);
        QCOMPARE(qAlpha(shown.pixel(99, 100)), 0);
        QCOMPARE(qAlpha(shown.pixel(100, 100)), 255);
        QCOMPARE(qAlpha(shown.pixel(299, 149)), 255);
        QCOMPARE(qAlpha(shown.pixel(300, 149)), 0);
    }

    void whatIsNotLitShowsUnderAndOverIt()
    {
        PreviewImage image = imageOf(QRectF(QPointF(), QSizeF(CanvasSize)), 1);
        image.picture.fill(Qt::transparent);
        LitPicture picture;
        picture.setPicture(image, QTransform());
        QCOMPARE(QColor(shownBy(picture, QTransform(), 1).pixel(50, 50)), QColor(Qt::white));
        FrameExport hills;
        hills.image = QImage(CanvasSize, QImage::Format_RGBA8888);
        hills.image.fill(QColor(0, 128, 0));
        picture.setUnlitLayers(hills, {});
        QCOMPARE(QColor(shownBy(picture, QTransform(), 1).pixel(50, 50)), QColor(0, 128, 0));
        image.picture.fill(Qt::red);
        picture.setPicture(image, QTransform());
        QCOMPARE(QColor(shownBy(picture, QTransform(), 1).pixel(50, 50)), QColor(Qt::red));
        // A plate in front, seen by a camera that has moved since.
        FrameExport rain;
        rain.image = QImage(10, 10, QImage::Format_RGBA8888);
        rain.image.fill(Qt::blue);
        rain.canvasToImage = QTransform::fromTranslate(-60, -60);
        picture.setUnlitLayers(hills, rain);
        QCOMPARE(QColor(shownBy(picture, QTransform(), 1).pixel(65, 65)), QColor(Qt::blue));
        QCOMPARE(QColor(shownBy(picture, QTransform(), 1).pixel(59, 65)), QColor(Qt::red));
    }

    void theOverlayCoversTheDrawingOnlyWhileItShowsAPicture()
    {
        FakeHost host;
        SceneDocument document;
        document.reset(sceneWithLight(-5000, -5000, 200));
        CanvasOverlay overlay(host, document);
        host.open();
        overlay.setPlaying(true);
        overlay.show();
        overlay.updateHandles();
        QCOMPARE(overlay.size(), host.mCanvas->size());
        overlay.setPicture(imageOf(QRectF(QPointF(), QSizeF(CanvasSize)), 1), QTransform());
        const auto at = [&host](int x, int y)
        {
            return QColor(host.mCanvas->grab().toImage().pixel(x, y));
        };
        QCOMPARE(at(265, 95), QColor(255, 0, 0));
        overlay.setComparing(true);
        QVERIFY(at(265, 95) != QColor(255, 0, 0));
        overlay.setComparing(false);
        QCOMPARE(at(265, 95), QColor(255, 0, 0));
        overlay.clearPicture();
        QVERIFY(at(265, 95) != QColor(255, 0, 0));
    }

    void theOverlayFollowsTheCanvas()
    {
        FakeHost host;
        SceneDocument document;
        CanvasOverlay overlay(host, document);
        host.open();
        host.mCanvas->resize(321, 123);
        QCOMPARE(overlay.size(), QSize(321, 123));
    }
};

QTEST_MAIN(PictureTest)
#include "test_picture.moc"
