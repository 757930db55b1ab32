// What each layer of the drawing is to the light.
#pragma once

#include <QMap>
#include <QString>

namespace lampblack
{

/// Role by the layer's name: "character" and "line" are lit, "background" stays as drawn, "result" is a layer
/// that Lampblack made.
using LayerRoles = QMap<QString, QString>;

inline QString resultLayer()
{
    return QStringLiteral("Lit");
}

/// The layer of lit frames that are taken apart, which shows one of their layers, such as "floor_shadow".
inline QString resultLayer(const QString& apart)
{
    return resultLayer() + QStringLiteral(": ") + QString(apart).replace(QLatin1Char('_'), QLatin1Char(' '));
}

/// The layer whose paint is light.
inline QString lightLayer()
{
    return QStringLiteral("Light");
}

/// Whether the paint of a layer is light: that of one of the right name, unless it has the role of a
/// character or a line.
inline bool isLight(const QString& layer, const LayerRoles& roles)
{
    const QString background = QStringLiteral("background");
    return layer == lightLayer() && roles.value(layer, background) == background;
}

/// The role of a layer that is not of results. Until one is called a character or a line, all are characters;
/// from then on, a layer without a role is background. Painted light is no part of the character.
inline QString roleOf(const QString& layer, const LayerRoles& roles)
{
    const QString character = QStringLiteral("character");
    if (isLight(layer, roles))
        return QStringLiteral("background");
    const QList<QString> given = roles.values();
    const bool named = given.contains(character) || given.contains(QStringLiteral("line"));
    return roles.value(layer, named ? QStringLiteral("background") : character);
}

/// Whether a layer holds results: it is never lit again. One of the right name counts even where no scene
/// says so.
inline bool isResult(const QString& layer, const LayerRoles& roles)
{
    const bool isNamedSo = layer == resultLayer() || layer.startsWith(resultLayer(QString()));
    return roles.value(layer) == QLatin1String("result") || (isNamedSo && !roles.contains(layer));
}

} // namespace lampblack
