#include "tool/canvas/frame_colours.h"

#include <QColor>
#include <QtMath>

#include <algorithm>
#include <iterator>
#include <limits>

namespace lampblack
{

namespace
{

constexpr int MinAlpha = 128;
constexpr int SearchRadius = 4;            // pixels
constexpr int MaxSquaredDistance = 3 * 64; // sum of squares: 8 levels a channel

int squaredDistance(QRgb a, QRgb b)
{
    const int red = qRed(a) - qRed(b);
    const int green = qGreen(a) - qGreen(b);
    const int blue = qBlue(a) - qBlue(b);
    return red * red + green * green + blue * blue;
}

} // namespace

void FrameColours::setSwatches(const QVector<Swatch>& swatches)
{
    mSwatches.clear();
    for (const Swatch& swatch : swatches)
        mSwatches << QColor(swatch.colour).rgb();
}

QString FrameColours::at(const QPointF& canvas) const
{
    const QPointF place = mFrame.canvasToImage.map(canvas);
    const QPoint pixel(qFloor(place.x()), qFloor(place.y()));
    if (!mFrame.image.valid(pixel) || qAlpha(mFrame.image.pixel(pixel)) < MinAlpha)
        return {};
    const QRgb drawn = mFrame.image.pixel(pixel);
    QRgb best = drawn;
    // Prefer a nearby pixel that has the colour of a swatch. On ink, the most similar swatch would be wrong.
    int nearestPixel = std::numeric_limits<int>::max();
    for (int dy = -SearchRadius; dy <= SearchRadius; ++dy)
    {
        for (int dx = -SearchRadius; dx <= SearchRadius; ++dx)
        {
            const QPoint neighbour = pixel + QPoint(dx, dy);
            const int pixelDistance = dx * dx + dy * dy;
            if (pixelDistance >= nearestPixel || !mFrame.image.valid(neighbour))
                continue;
            const QRgb colour = mFrame.image.pixel(neighbour);
            if (qAlpha(colour) < MinAlpha)
                continue;
            for (const QRgb swatch : mSwatches)
            {
                if (squaredDistance(colour, swatch) <= MaxSquaredDistance)
                {
                    nearestPixel = pixelDistance;
                    best = swatch;
                    break;
                }
            }
        }
    }
    if (nearestPixel == std::numeric_limits<int>::max())
    {
        int nearestColour = std::numeric_limits<int>::max();
        for (const QRgb swatch : mSwatches)
        {
            const int colourDistance = squaredDistance(drawn, swatch);
            if (colourDistance < nearestColour)
            {
                nearestColour = colourDistance;
                best = swatch;
            }
        }
    }
    return QColor(best).name();
}

QRectF FrameColours::drawnBox() const
{
    const QImage& image = mFrame.image;
    QRect box;
    for (int row = 0; row < image.height(); ++row)
    {
        const auto* line = reinterpret_cast<const QRgb*>(image.constScanLine(row));
        const auto isDrawn = [](QRgb pixel)
        {
            return qAlpha(pixel) >= MinAlpha; // alpha is the last byte of RGBA8888 too
        };
        const auto* end = line + image.width();
        const auto* first = std::find_if(line, end, isDrawn);
        if (first == end)
            continue;
        const auto* last =
            std::find_if(std::make_reverse_iterator(end), std::make_reverse_iterator(first), isDrawn).base();
        box |= QRect(QPoint(int(first - line), row), QPoint(int(last - line) - 1, row));
    }
    if (box == image.rect())
        return {};
    return mFrame.canvasToImage.inverted().mapRect(QRectF(box));
}

} // namespace lampblack
