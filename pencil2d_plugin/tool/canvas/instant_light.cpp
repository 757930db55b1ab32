#include "tool/canvas/instant_light.h"

#include "scene/linear_light.h"
#include "tool/canvas/instant_tones.h"

#include <QVector3D>

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{

/// A light as it is seen from the image.
struct Source
{
    QVector3D place; ///< image pixels; of a sun the unit direction towards it
    double radius;   ///< image pixels; of a sun the sine of its angular radius
    bool isSun;
    bool isBehind;
    LinearColour colour; ///< times power
};

QVector<Source> sourcesOf(const Scene& scene, const QTransform& canvasToImage, double scale)
{
    const bool alone = std::any_of(scene.lights.begin(), scene.lights.end(),
                                   [](const AreaLight& light) { return light.on && light.solo; });
    QVector<Source> sources;
    for (const AreaLight& light : scene.lights)
    {
        if (!light.on || (alone && !light.solo) || light.power <= 0)
            continue;
        const QPointF at = canvasToImage.map(QPointF(light.x, light.y));
        Source source{QVector3D(float(at.x()), float(at.y()), float(light.z * scale)), light.size / 2 * scale,
                      light.kind == LightKind::Sun, light.z < 0, linearColour(light.colour, light.power)};
        if (source.isSun)
        {
            const QPointF middle =
                canvasToImage.map(QPointF(scene.canvas.width / 2.0, scene.canvas.height / 2.0));
            const QVector3D towards = source.place - QVector3D(float(middle.x()), float(middle.y()), 0);
            const double distance = std::max(1e-3, double(towards.length()));
            source.place = towards.normalized();
            source.radius /= std::hypot(source.radius, distance);
        }
        sources.append(source);
    }
    return sources;
}

/// The mean cosine over a disc of light whose middle has `cosine`, partly below the horizon.
double facing(double cosine, double sineOfRadius)
{
    if (cosine >= sineOfRadius)
        return cosine;
    if (cosine <= -sineOfRadius)
        return 0;
    return (cosine + sineOfRadius) * (cosine + sineOfRadius) / (4 * sineOfRadius);
}

/// Light of power 1 on a point, relative to what shows the drawn colour.
double received(const Source& source, const QVector3D& point, const QVector3D& normal, double unit)
{
    if (source.isSun)
        return facing(QVector3D::dotProduct(normal, source.place), std::max(1e-3, source.radius));
    const QVector3D towards = source.place - point;
    const double distance = std::max(1e-3, double(towards.length()));
    const QVector3D direction = towards / float(distance);
    // The disc faces the paper.
    const double leaving = source.isBehind ? -direction.z() : direction.z();
    if (leaving <= 0)
        return 0;
    const double radius = source.radius / unit;
    const double away = distance / unit;
    const double falloff = (radius * radius + 1) / (radius * radius + away * away);
    const double sine = source.radius / std::hypot(source.radius, distance);
    return falloff * leaving * facing(QVector3D::dotProduct(normal, direction), std::max(1e-3, sine));
}

/// Elements beside the figure take the light of their neighbours in it, so that edges are smooth.
void spread(QVector<float>& values, const InstantShape& shape)
{
    constexpr int Reach = 3;
    const int width = shape.size.width();
    const int height = shape.size.height();
    QVector<char> known = shape.figure;
    for (int ring = 0; ring < Reach; ++ring)
    {
        const QVector<char> before = known;
        for (int y = 0; y < height; ++y)
        {
            for (int x = 0; x < width; ++x)
            {
                if (before[y * width + x] != 0)
                    continue;
                float sum = 0;
                int count = 0;
                for (int j = std::max(0, y - 1); j <= std::min(y + 1, height - 1); ++j)
                {
                    for (int i = std::max(0, x - 1); i <= std::min(x + 1, width - 1); ++i)
                    {
                        if (before[j * width + i] == 0)
                            continue;
                        sum += values[j * width + i];
                        ++count;
                    }
                }
                if (count == 0)
                    continue;
                values[y * width + x] = sum / float(count);
                known[y * width + x] = 1;
            }
        }
    }
}

} // namespace

InstantLight lightOn(const InstantShape& shape, const Scene& scene, const QTransform& canvasToImage)
{
    const double scale = std::sqrt(std::abs(canvasToImage.determinant()));
    const double unit = defaultHeight(scene.canvas) * scale;
    const QVector<Source> sources = sourcesOf(scene, canvasToImage, scale);
    const LinearColour ambient = linearColour(scene.ambient.colour, scene.ambient.strength);
    InstantLight light;
    for (QVector<float>* channel : {&light.red, &light.green, &light.blue})
        channel->fill(1, shape.count());
    const InstantTones tones(scene);
    const QTransform imageToCanvas = canvasToImage.inverted();
    if (!tones.isEmpty())
        light.amount.fill(0, shape.count());
    const auto relief = float(scene.reliefScale);
    for (int at = 0; at < shape.count(); ++at)
    {
        if (shape.figure[at] == 0)
            continue;
        const int x = at % shape.size.width();
        const int y = at / shape.size.width();
        const QVector3D point(float((x + 0.5) * shape.step), float((y + 0.5) * shape.step),
                              relief * shape.height[at]);
        const QVector3D normal =
            QVector3D(relief * shape.nx[at], relief * shape.ny[at], shape.nz[at]).normalized();
        LinearColour sum = ambient;
        for (const Source& source : sources)
        {
            const double share = received(source, point, normal, unit);
            for (size_t i = 0; i < sum.size(); ++i)
                sum[i] += share * source.colour[i];
        }
        if (!tones.isEmpty())
        {
            const double direct = std::max({sum[0] - ambient[0], sum[1] - ambient[1], sum[2] - ambient[2]});
            const QPointF place = imageToCanvas.map(QPointF(point.x(), point.y()));
            light.amount[at] = float(direct / tones.fullLight(place.x(), place.y()));
        }
        light.red[at] = float(fromLinear(sum[0]));
        light.green[at] = float(fromLinear(sum[1]));
        light.blue[at] = float(fromLinear(sum[2]));
    }
    for (QVector<float>* channel : {&light.red, &light.green, &light.blue})
        spread(*channel, shape);
    if (!tones.isEmpty())
        spread(light.amount, shape);
    return light;
}

} // namespace lampblack
