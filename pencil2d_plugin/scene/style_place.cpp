#include "scene/style_place.h"

#include "scene/generated/style_presets.h"

#include <QJsonDocument>

#include <algorithm>

namespace lampblack
{

namespace
{
constexpr double Narrowest = 0.25;
constexpr double Widest = 1000;
} // namespace

QVector<Style> presetStyles()
{
    QVector<Style> styles;
    for (const char* text : StyleTexts)
        styles << styleFromJson(QJsonDocument::fromJson(text).object()).value_or(Style());
    return styles;
}

Scene withStyle(Scene scene, const Style& style)
{
    scene.look = style.look;
    scene.rim = scaledRim(style.rim, defaultHeight(scene.canvas) / defaultHeight(style.canvas));
    return scene;
}

std::optional<Rim> scaledRim(std::optional<Rim> rim, double scale)
{
    if (rim)
        rim->width = std::clamp(rim->width * scale, Narrowest, Widest);
    return rim;
}

} // namespace lampblack
