#include "tool/canvas/instant_shading.h"

#include "tool/canvas/instant_tones.h"

#include <QHash>
#include <QVector3D>

#include <algorithm>
#include <array>
#include <cmath>

namespace lampblack
{

namespace
{

constexpr double Gamma = 2.2;

/// A light as it is seen from the image.
struct Source
{
    QVector3D place; ///< image pixels; of a sun the unit direction towards it
    double radius;   ///< image pixels; of a sun the sine of its angular radius
    bool isSun;
    bool isBehind;
    std::array<double, 3> colour; ///< linear, times power
};

double linear(double srgb)
{
    return std::pow(srgb, Gamma);
}

std::array<double, 3> linearColour(const QColor& colour, double strength)
{
    return {strength * linear(colour.redF()), strength * linear(colour.greenF()),
            strength * linear(colour.blueF())};
}

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

float multiplier(double light)
{
    return float(std::pow(std::max(0.0, light), 1 / Gamma));
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

/// Red, green and blue of the light at a place, how far lines enclose it, and its amount where there are
/// tones.
using Values = std::array<float, 5>;

/// A row of the picture's elements, interpolated between two rows of the grid.
class Row
{
public:
    Row(const InstantShape& shape, const InstantLight& light, int width, double step)
        : mShape(shape), mLight(light), mValues(shape.size.width()), mColumns(width)
    {
        for (int x = 0; x < width; ++x)
            mColumns[x] = between((x + 0.5) * step, shape.size.width());
    }
    void moveTo(double imageY)
    {
        const Place place = between(imageY, mShape.size.height());
        const int width = mShape.size.width();
        for (int x = 0; x < width; ++x)
        {
            const int a = place.first * width + x;
            const int b = place.second * width + x;
            const auto mix = [&place](float one, float other)
            {
                return one + place.share * (other - one);
            };
            mValues[x] = {mix(mLight.red[a], mLight.red[b]), mix(mLight.green[a], mLight.green[b]),
                          mix(mLight.blue[a], mLight.blue[b]), mix(mShape.enclosed[a], mShape.enclosed[b]),
                          mLight.amount.isEmpty() ? 0 : mix(mLight.amount[a], mLight.amount[b])};
        }
    }
    bool isOpen(int x) const
    {
        const Place& place = mColumns.constData()[x];
        return mValues.constData()[place.first][3] <= 0 && mValues.constData()[place.second][3] <= 0;
    }
    Values at(int x) const
    {
        const Place& place = mColumns.constData()[x];
        const Values& one = mValues.constData()[place.first];
        const Values& other = mValues.constData()[place.second];
        Values values{};
        for (size_t i = 0; i < values.size(); ++i)
            values[i] = one[i] + place.share * (other[i] - one[i]);
        return values;
    }

private:
    struct Place
    {
        int first;
        int second;
        float share;
    };
    Place between(double image, int count) const
    {
        const double at = std::clamp(image / mShape.step - 0.5, 0.0, double(count - 1));
        const int first = int(at);
        return {first, std::min(first + 1, count - 1), float(at - first)};
    }

    const InstantShape& mShape;
    const InstantLight& mLight;
    QVector<Values> mValues;
    QVector<Place> mColumns;
};

enum class Paint
{
    AsDrawn,
    Smooth,
    Toned
};

Paint paintOf(const Material& material, const Look& look)
{
    if ((!material.diffuse && !material.glossy) || material.emission > 0)
        return Paint::AsDrawn;
    if (material.look == LookChoice::Scene)
        return look.tones.isEmpty() ? Paint::Smooth : Paint::Toned;
    return material.look == LookChoice::Cel ? Paint::Toned : Paint::Smooth;
}

/// The colours that are not shown as all others are.
QHash<QRgb, Paint> ownPaints(const Scene& scene)
{
    QHash<QRgb, Paint> own;
    const Paint usual = paintOf(scene.defaultMaterial, scene.look);
    for (auto material = scene.materials.begin(); material != scene.materials.end(); ++material)
    {
        const Paint paint = paintOf(material.value(), scene.look);
        if (paint != usual)
            own.insert(QColor(material.key()).rgb(), paint);
    }
    return own;
}

} // namespace

InstantLight lightOn(const InstantShape& shape, const Scene& scene, const QTransform& canvasToImage)
{
    const double scale = std::sqrt(std::abs(canvasToImage.determinant()));
    const double unit = defaultHeight(scene.canvas) * scale;
    const QVector<Source> sources = sourcesOf(scene, canvasToImage, scale);
    const std::array<double, 3> ambient = linearColour(scene.ambient.colour, scene.ambient.strength);
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
        std::array<double, 3> sum = ambient;
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
        light.red[at] = multiplier(sum[0]);
        light.green[at] = multiplier(sum[1]);
        light.blue[at] = multiplier(sum[2]);
    }
    for (QVector<float>* channel : {&light.red, &light.green, &light.blue})
        spread(*channel, shape);
    if (!tones.isEmpty())
        spread(light.amount, shape);
    return light;
}

QImage shadedDrawing(const QImage& drawing, const InstantShape& shape, const InstantLight& light,
                     const Scene& scene, int longSide)
{
    const QImage source = drawing.convertToFormat(QImage::Format_RGBA8888);
    const double step = std::max(1.0, double(std::max(source.width(), source.height())) / longSide);
    const QSize size(std::max(1, int(source.width() / step)), std::max(1, int(source.height() / step)));
    QImage picture(size, QImage::Format_RGBA8888_Premultiplied);
    picture.fill(Qt::transparent);
    const Paint usual = paintOf(scene.defaultMaterial, scene.look);
    const QHash<QRgb, Paint> own = ownPaints(scene);
    const InstantTones tones(scene);
    Row row(shape, light, size.width(), step);
    for (int y = 0; y < size.height(); ++y)
    {
        const double imageY = (y + 0.5) * step;
        const uchar* pixels = source.constScanLine(int(imageY));
        uchar* out = picture.scanLine(y);
        row.moveTo(imageY);
        for (int x = 0; x < size.width(); ++x, out += 4)
        {
            const uchar* pixel = pixels + 4 * int((x + 0.5) * step);
            if (pixel[3] == 0 && row.isOpen(x))
                continue;
            Values lamp = row.at(x);
            const float enclosed = lamp[3];
            const Paint paint = own.isEmpty() ? usual : own.value(qRgb(pixel[0], pixel[1], pixel[2]), usual);
            if (paint == Paint::Toned && !light.amount.isEmpty())
                std::copy_n(tones.at(lamp[4]).begin(), 3, lamp.begin());
            const float part = paint == Paint::AsDrawn ? 0 : (shape.onGround ? enclosed : 1);
            for (size_t i = 0; i < 3; ++i)
                lamp[i] = 1 + part * (lamp[i] - 1);
            // Bare paper that lines enclose is lit as if it were white, and the white is taken away again.
            const float alpha = float(pixel[3]) / 255;
            const float bare = (1 - alpha) * enclosed;
            const float least = bare > 0 ? std::min({lamp[0], lamp[1], lamp[2], 1.0F}) : 1;
            const float most = 255 * (alpha + bare * (1 - least));
            std::array<float, 3> value{};
            for (size_t i = 0; i < value.size(); ++i)
                value[i] = alpha * float(pixel[i]) * lamp[i] + 255 * bare * (lamp[i] - least);
            // What is too bright keeps its hue.
            const float peak = std::max({value[0], value[1], value[2]});
            const float scale = peak > most ? most / peak : 1;
            for (size_t i = 0; i < value.size(); ++i)
                out[i] = uchar(scale * value[i] + 0.5F);
            out[3] = uchar(most + 0.5F);
        }
    }
    return picture;
}

} // namespace lampblack
