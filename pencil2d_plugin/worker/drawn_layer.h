// One layer of a drawing.
#pragma once

#include <QImage>
#include <QString>
#include <QVector>

namespace lampblack
{

struct DrawnLayer
{
    QString name;
    QImage pixels; ///< as large as the drawing, Format_RGBA8888
};

/// Bottom first. None: the drawing is one body.
using DrawnLayers = QVector<DrawnLayer>;

} // namespace lampblack
