#include "tool/canvas/instant_shading.h"

#include "tool/canvas/instant_tones.h"

#include <QHash>

#include <algorithm>
#include <array>

namespace lampblack
{

namespace
{

/// Red, green and blue of the light at a place, how far lines enclose it, and its amount where there are
/// tones.
using Values = std::array<float, 5>;

using Colour = std::array<float, 3>; ///< sRGB, 0 to 255, or brighter

constexpr std::array<uchar, 3> White{255, 255, 255};

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

/// 0 for a colour that is as dark as a line, on which there is no rim; 1 for paint.
float paintShare(const uchar* drawn)
{
    const float peak = std::max({drawn[0], drawn[1], drawn[2]});
    return std::clamp(peak / DarkestPaint - 0.5F, 0.0F, 1.0F);
}

} // namespace

QImage shadedDrawing(const QImage& drawing, const InstantShape& shape, const InstantLight& light,
                     const InstantRim& rim, const Scene& scene, int longSide)
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
            Colour shown{float(pixel[0]) * lamp[0], float(pixel[1]) * lamp[1], float(pixel[2]) * lamp[2]};
            Colour paper{255 * lamp[0], 255 * lamp[1], 255 * lamp[2]};
            const float alpha = float(pixel[3]) / 255;
            // Bare paper that lines enclose is lit as if it were white, and the white is taken away again.
            const float bare = (1 - alpha) * enclosed;
            if (const float edge = part * rim.shareAt((x + 0.5) * step, imageY); edge > 0)
            {
                rim.add(edge * paintShare(pixel), pixel, shown);
                if (bare > 0)
                    rim.add(edge, White.data(), paper);
            }
            const float least =
                bare > 0 ? std::min({paper[0] / 255, paper[1] / 255, paper[2] / 255, 1.0F}) : 1;
            const float most = 255 * (alpha + bare * (1 - least));
            Colour value{};
            for (size_t i = 0; i < value.size(); ++i)
                value[i] = alpha * shown[i] + bare * (paper[i] - 255 * least);
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
