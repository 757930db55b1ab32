// Looks to choose from, as pictures.
#pragma once

#include "scene/scene.h"

#include <QIcon>

namespace lampblack
{

/// A style that comes with Lampblack, in words and as a picture.
struct LookPicture
{
    QString id;   ///< for object names
    QString name; ///< short, under the picture
    QString hint;
    Style style;
};

QVector<LookPicture> lookPictures();

/// A ball in the style, lit from the upper left.
QIcon styleIcon(const Style& style, int side, double pixelRatio);

} // namespace lampblack
