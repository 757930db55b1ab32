#include "tool/canvas/figure_mask.h"

#include <QPoint>

#include <algorithm>
#include <cstdlib>

namespace lampblack
{

namespace
{

constexpr int Opaque = 128; ///< least alpha of what is drawn
constexpr int Alike = 12;   ///< of 255: largest difference in a channel from the ground's colour

bool isAlike(Pixel a, Pixel b)
{
    return std::abs(a[0] - b[0]) <= Alike && std::abs(a[1] - b[1]) <= Alike && std::abs(a[2] - b[2]) <= Alike;
}

} // namespace

bool isDrawn(Pixel pixel)
{
    return pixel[3] >= Opaque;
}

Pixel pixelOf(const QImage& image, int x, int y)
{
    return image.constScanLine(y) + 4 * x;
}

bool isOnGround(const QImage& image)
{
    const int right = image.width() - 1;
    const int bottom = image.height() - 1;
    const Pixel first = pixelOf(image, 0, 0);
    for (const QPoint& at : {QPoint(0, 0), QPoint(right, 0), QPoint(0, bottom), QPoint(right, bottom)})
    {
        const Pixel pixel = pixelOf(image, at.x(), at.y());
        if (!isDrawn(pixel) || !isAlike(pixel, first))
            return false;
    }
    return true;
}

QVector<char> drawnElements(const QImage& image, const QSize& size, double step, bool onGround)
{
    QVector<char> drawn(size.width() * size.height(), 0);
    const Pixel ground = pixelOf(image, 0, 0);
    QVector<int> columns(image.width());
    for (int x = 0; x < image.width(); ++x)
        columns[x] = std::min(int(x / step), size.width() - 1);
    for (int y = 0; y < image.height(); ++y)
    {
        char* row = drawn.data() + std::min(int(y / step), size.height() - 1) * size.width();
        const int* column = columns.constData();
        Pixel pixel = image.constScanLine(y);
        for (int x = 0; x < image.width(); ++x, ++column, pixel += 4)
        {
            if (isDrawn(pixel) && !(onGround && isAlike(pixel, ground)))
                row[*column] = 1;
        }
    }
    return drawn;
}

QVector<char> enclosedBy(const QVector<char>& drawn, const QSize& size)
{
    const int width = size.width();
    const int height = size.height();
    QVector<char> inside(drawn.size(), 1);
    QVector<QPoint> front;
    const auto reach = [&](int x, int y)
    {
        const int at = y * width + x;
        if (x < 0 || y < 0 || x >= width || y >= height || inside[at] == 0 || drawn[at] != 0)
            return;
        inside[at] = 0;
        front.append(QPoint(x, y));
    };
    for (int x = 0; x < width; ++x)
    {
        reach(x, 0);
        reach(x, height - 1);
    }
    for (int y = 0; y < height; ++y)
    {
        reach(0, y);
        reach(width - 1, y);
    }
    while (!front.isEmpty())
    {
        const QPoint at = front.takeLast();
        reach(at.x() - 1, at.y());
        reach(at.x() + 1, at.y());
        reach(at.x(), at.y() - 1);
        reach(at.x(), at.y() + 1);
    }
    return inside;
}

} // namespace lampblack
