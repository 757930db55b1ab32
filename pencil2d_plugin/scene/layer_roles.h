// What each layer of the drawing is to the light.
#pragma once

#include <QMap>
#include <QString>

namespace lampblack
{

/// Role by the layer's name: "character" and "line" are lit, "background" stays as drawn, "result" is the
/// layer that Lampblack made.
using LayerRoles = QMap<QString, QString>;

inline QString resultLayer()
{
    return QStringLiteral("Lit");
}

/// Whether a layer holds results: it is never lit again. One of the right name counts even where no scene
/// says so.
inline bool isResult(const QString& layer, const LayerRoles& roles)
{
    return roles.value(layer) == QLatin1String("result") ||
           (layer == resultLayer() && !roles.contains(layer));
}

} // namespace lampblack
