// The lines along which one part of the drawing is in front of another, as the artist sees and clicks them.
#pragma once

#include "scene/scene.h"
#include "worker/worker.h"

#include <QPolygonF>
#include <QTransform>

namespace lampblack
{

/// A cut of the surface at one frame: one that was found, or a correction.
struct Cut
{
    QPolygonF line; ///< canvas pixels
    FrontSide front = FrontSide::Left;
    double amount = 0;        ///< height of the step, canvas pixels; 0 if it is not known
    bool isCorrected = false; ///< a hint made it so, of this frame or of another
    int hint = -1;            ///< index of the hint of this frame that it is, or -1
};

/// The hints of this frame, then the overlaps that no hint of this frame is about.
QVector<Cut> cutsAt(const Scene& scene, int frame, const QVector<Overlap>& overlaps);

/// Index of the cut under `position` (widget coordinates), or -1. `reach` is in widget pixels.
int cutUnder(const QVector<Cut>& cuts, const QTransform& canvasToWidget, const QPointF& position,
             double reach);

/// Distance from a point to the nearest point of a line.
double distanceTo(const QPolygonF& line, const QPointF& point);

double lengthOf(const QPolygonF& line);

/// At most `most` points of the line, those that keep its shape. `most` is at least 2.
QPolygonF simplified(const QPolygonF& line, int most);

} // namespace lampblack
