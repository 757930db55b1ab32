// Light that is taken off a lit picture and put on a drawing.
#include "tool/canvas/light_ratio.h"

#include <QtTest>

#include <cstdlib>

using namespace lampblack;

namespace
{

const QSize Size(120, 80);

QImage filled(const QColor& colour)
{
    QImage image(Size, QImage::Format_RGB32);
    image.fill(colour);
    return image;
}

/// Two colours with a line of ink between them.
QImage drawing()
{
    QImage image = filled(QColor(200, 120, 60));
    QPainter painter(&image);
    painter.fillRect(60, 0, 60, 80, QColor(80, 140, 180));
    painter.fillRect(57, 0, 6, 80, Qt::black);
    return image;
}

QImage times(const QImage& image, double left, double right)
{
    QImage lit = image;
    for (int y = 0; y < lit.height(); ++y)
    {
        for (int x = 0; x < lit.width(); ++x)
        {
            const double by = left + (right - left) * x / lit.width();
            const QColor colour(image.pixel(x, y));
            lit.setPixelColor(
                x, y, QColor(int(colour.red() * by), int(colour.green() * by), int(colour.blue() * by)));
        }
    }
    return lit;
}

QImage relit(const QImage& drawn, const LightRatio& ratio)
{
    QImage image = drawn;
    QPainter painter(&image);
    ratio.paint(painter, QPointF());
    return image;
}

int largestDifference(const QImage& a, const QImage& b)
{
    int largest = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            for (int shift : {0, 8, 16})
                largest = std::max(
                    largest, std::abs(int(a.pixel(x, y) >> shift & 255) - int(b.pixel(x, y) >> shift & 255)));
    return largest;
}

} // namespace

class LightRatioTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void drawingBecomesTheLitPicture()
    {
        const QImage drawn = drawing();
        const QImage lit = times(drawn, 0.3, 1.25);
        QVERIFY(largestDifference(relit(drawn, ratioOf(lit, drawn)), lit) <= 6);
    }

    void equalPicturesMakeNoLight()
    {
        const QImage drawn = drawing();
        const LightRatio ratio = ratioOf(drawn, drawn);
        QVERIFY(ratio.brighter.isNull());
        QVERIFY(largestDifference(relit(drawn, ratio), drawn) <= 1);
    }

    void strokeIsLitLikeWhatIsBeneathIt()
    {
        const QImage drawn = filled(QColor(200, 200, 200));
        const LightRatio ratio = ratioOf(times(drawn, 0.5, 0.5), drawn);
        QImage stroke = drawn;
        QPainter(&stroke).fillRect(20, 20, 40, 10, QColor(240, 80, 40));
        const QColor shown(relit(stroke, ratio).pixel(30, 25));
        QVERIFY(std::abs(shown.red() - 120) < 4 && std::abs(shown.green() - 40) < 4);
    }

    void whatWasInkIsLitLikeItsSurroundings()
    {
        const QImage drawn = drawing();
        const LightRatio ratio = ratioOf(times(drawn, 0.5, 0.5), drawn);
        QImage erased = drawn;
        QPainter(&erased).fillRect(57, 0, 6, 80, QColor(200, 200, 200));
        QVERIFY(std::abs(qRed(relit(erased, ratio).pixel(60, 40)) - 100) < 15);
    }

    void picturesOfOtherSizesAreNoPair()
    {
        QVERIFY(ratioOf(drawing(), QImage(3, 3, QImage::Format_RGB32)).isNull());
        QVERIFY(ratioOf(QImage(), QImage()).isNull());
    }
};

QTEST_GUILESS_MAIN(LightRatioTest)
#include "test_light_ratio.moc"
