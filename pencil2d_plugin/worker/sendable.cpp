#include "worker/sendable.h"

#include "protocol/generated/limits.h"
#include "scene/layer_roles.h"

#include <QRegularExpression>

#include <cmath>

namespace lampblack
{

namespace
{

constexpr int MaxDevicePixels = 4096; // width or height of a preview
constexpr int MaxListLength = 1024;

} // namespace

bool isFinite(const QRectF& rect)
{
    return std::isfinite(rect.x()) && std::isfinite(rect.y()) && std::isfinite(rect.width()) &&
           std::isfinite(rect.height());
}

QRectF bounded(const QRectF& crop)
{
    constexpr double Far = 100000;
    return {qBound(-Far, crop.x(), Far), qBound(-Far, crop.y(), Far), qBound(0.01, crop.width(), Far),
            qBound(0.01, crop.height(), Far)};
}

QSize bounded(const QSize& size)
{
    const QSize most(MaxDevicePixels, MaxDevicePixels);
    const bool fits = size.width() <= most.width() && size.height() <= most.height();
    return (fits ? size : size.scaled(most, Qt::KeepAspectRatio)).expandedTo(QSize(1, 1));
}

DrawnLayers sendable(DrawnLayers layers, const QSize& size)
{
    constexpr int MaxLayers = 16;
    constexpr int MaxName = 128;
    static const QRegularExpression control(QStringLiteral("[\\x00-\\x1f\\x7f]"));
    const qint64 pixels = qint64(size.width()) * size.height() * (1 + layers.size());
    if (layers.size() > MaxLayers || pixels > protocol::Limits().framePixels)
    {
        const bool hasLight = !layers.isEmpty() && layers.last().name == lightLayer();
        return hasLight && layers.size() > 1 ? sendable({layers.last()}, size) : DrawnLayers();
    }
    for (DrawnLayer& layer : layers)
    {
        layer.name = layer.name.left(MaxName).replace(control, QStringLiteral(" "));
        if (layer.pixels.size() != size)
        {
            return {};
        }
    }
    return layers;
}

bool isOutput(const QString& output)
{
    static const QRegularExpression pattern(
        QStringLiteral("\\A/[^%\\x00-\\x1f\\x7f]*%0[1-9]d\\.(png|exr)\\z"));
    return output.size() <= MaxListLength && pattern.match(output).hasMatch();
}

} // namespace lampblack
