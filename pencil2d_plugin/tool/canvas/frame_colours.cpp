#include "tool/canvas/frame_colours.h"

#include <QColor>
#include <QtMath>

#include <limits>

namespace lampblack
{

namespace
{

constexpr int DrawnAlpha = 128;
constexpr int InkReach = 4;        // pixels that are looked at around a line
constexpr int SameColour = 3 * 64; // sum of squares: 8 levels a channel

int apart(QRgb a, QRgb b)
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
    if (!mFrame.image.valid(pixel) || qAlpha(mFrame.image.pixel(pixel)) < DrawnAlpha)
        return {};
    const QRgb drawn = mFrame.image.pixel(pixel);
    QRgb best = drawn;
    // A pixel of a swatch's own colour close by says more than the nearest colour to ink.
    int nearest = std::numeric_limits<int>::max();
    for (int dy = -InkReach; dy <= InkReach; ++dy)
    {
        for (int dx = -InkReach; dx <= InkReach; ++dx)
        {
            const QPoint neighbour = pixel + QPoint(dx, dy);
            const int away = dx * dx + dy * dy;
            if (away >= nearest || !mFrame.image.valid(neighbour))
                continue;
            const QRgb colour = mFrame.image.pixel(neighbour);
            if (qAlpha(colour) < DrawnAlpha)
                continue;
            for (const QRgb swatch : mSwatches)
            {
                if (apart(colour, swatch) <= SameColour)
                {
                    nearest = away;
                    best = swatch;
                    break;
                }
            }
        }
    }
    if (nearest == std::numeric_limits<int>::max())
    {
        int least = std::numeric_limits<int>::max();
        for (const QRgb swatch : mSwatches)
        {
            const int off = apart(drawn, swatch);
            if (off < least)
            {
                least = off;
                best = swatch;
            }
        }
    }
    return QColor(best).name();
}

} // namespace lampblack
