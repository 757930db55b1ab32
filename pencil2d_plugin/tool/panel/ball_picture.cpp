#include "tool/panel/ball_picture.h"

#include <QImage>

#include <cmath>

namespace lampblack
{

namespace
{
constexpr int Over = 3; // samples a side, for smooth edges
constexpr double Line = 1.4;
const QRgb Ink = qRgba(40, 28, 32, 255);
} // namespace

QPixmap ballPicture(int side, double pixelRatio, const std::function<QColor(const QVector3D&)>& colourOf)
{
    const int pixels = int(std::lround(side * pixelRatio));
    QImage ball(pixels * Over, pixels * Over, QImage::Format_ARGB32);
    ball.fill(Qt::transparent);
    const double outside = ball.width() / 2.0;
    const double radius = outside - Line * Over * pixelRatio;
    for (int row = 0; row < ball.height(); ++row)
    {
        for (int column = 0; column < ball.width(); ++column)
        {
            const double x = (column + 0.5 - outside) / radius;
            const double y = (row + 0.5 - outside) / radius;
            const double away = std::hypot(x, y);
            if (away <= 1)
                ball.setPixel(column, row,
                              colourOf({float(x), float(y), float(std::sqrt(1 - away * away))}).rgba());
            else if (away * radius <= outside)
                ball.setPixel(column, row, Ink);
        }
    }
    QPixmap pixmap =
        QPixmap::fromImage(ball.scaled(pixels, pixels, Qt::IgnoreAspectRatio, Qt::SmoothTransformation));
    pixmap.setDevicePixelRatio(pixelRatio);
    return pixmap;
}

} // namespace lampblack
