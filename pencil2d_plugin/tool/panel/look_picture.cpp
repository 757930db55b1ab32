#include "tool/panel/look_picture.h"

#include "scene/generated/style_presets.h"
#include "scene/style_place.h"
#include "tool/panel/ball_picture.h"

#include <QCoreApplication>

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{

const QColor Paint(0x4f, 0x8f, 0xb3); ///< of the ball

QString tr(const char* text)
{
    return QCoreApplication::translate("lampblack::LookSection", text);
}

/// The step, 0..1, that `light`, 0..1, is on.
double toned(double light, const Look& look)
{
    if (look.tones.isEmpty())
        return light;
    const double width = std::max(look.softness, 0.02);
    double step = 0;
    for (const double threshold : look.tones)
        step += std::clamp((light - threshold) / width + 0.5, 0.0, 1.0);
    return step / double(look.tones.size());
}

QColor shaded(const QVector3D& normal, const Style& style)
{
    const QVector3D lamp = QVector3D(-0.55F, -0.6F, 0.58F).normalized();
    const double facing = std::max(0.0F, QVector3D::dotProduct(normal, lamp));
    const double light = 0.35 + 0.65 * toned(std::sqrt(facing), style.look);
    const bool inRim = style.rim && normal.z() < 0.55F && normal.x() + normal.y() > 0.2F;
    const double rim = inRim ? style.rim->strength : 0;
    const QColor tint = style.rim ? style.rim->colour : QColor(Qt::white);
    const auto channel = [&](double paint, double bright)
    {
        const double lit = paint * light;
        return lit + (bright - lit) * rim;
    };
    return QColor::fromRgbF(channel(Paint.redF(), tint.redF()), channel(Paint.greenF(), tint.greenF()),
                            channel(Paint.blueF(), tint.blueF()));
}

} // namespace

QVector<LookPicture> lookPictures()
{
    const QVector<QPair<QString, QString>> words{
        {tr("Smooth"), tr("Smooth: light fades over round surfaces, as in a painting")},
        {tr("Soft"), tr("Soft cel: light and shade with a soft edge")},
        {tr("Hard"), tr("Hard cel: light and shade with a clean edge, as inked by hand")},
        {tr("Rim"), tr("Two-tone + rim: light, deep shade, and a bright edge around the character")}};
    QVector<LookPicture> choices;
    const QVector<Style> styles = presetStyles();
    for (int place = 0; place < styles.size() && place < words.size(); ++place)
        choices << LookPicture{QLatin1String(StyleNames.at(size_t(place))), words[place].first,
                               words[place].second, styles[place]};
    return choices;
}

QIcon styleIcon(const Style& style, int side, double pixelRatio)
{
    return QIcon(
        ballPicture(side, pixelRatio, [&style](const QVector3D& normal) { return shaded(normal, style); }));
}

} // namespace lampblack
