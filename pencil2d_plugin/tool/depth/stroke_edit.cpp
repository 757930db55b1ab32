#include "tool/depth/stroke_edit.h"

#include "tool/depth/cuts.h"

#include <algorithm>

namespace lampblack
{

bool hasRoomForStroke(const Scene& scene)
{
    return scene.depth.strokes.size() < MaxStrokes;
}

Scene withStroke(const Scene& scene, int frame, const QPolygonF& line, const BrushSettings& brush)
{
    Scene result = scene;
    if (!hasRoomForStroke(scene) || line.isEmpty())
        return result;
    DepthStroke stroke;
    stroke.frame = frame;
    stroke.brush = brush.brush;
    stroke.radius = brush.radius;
    stroke.amount = brush.amount;
    const QPolygonF points = simplified(line, MaxStrokePoints);
    for (const QPointF& point : points)
        stroke.points.append({point.x(), point.y(), {}});
    result.depth.strokes.append(stroke);
    return result;
}

Scene withoutStroke(const Scene& scene, int stroke)
{
    Scene result = scene;
    if (stroke >= 0 && stroke < result.depth.strokes.size())
        result.depth.strokes.remove(stroke);
    return result;
}

Scene withoutStrokes(const Scene& scene, std::optional<int> frame)
{
    Scene result = scene;
    QVector<DepthStroke>& strokes = result.depth.strokes;
    strokes.erase(std::remove_if(strokes.begin(), strokes.end(),
                                 [frame](const DepthStroke& stroke)
                                 { return !frame || stroke.frame == *frame; }),
                  strokes.end());
    return result;
}

QPolygonF lineOf(const DepthStroke& stroke)
{
    QPolygonF line;
    for (const DepthPoint& point : stroke.points)
        line.append({point.x, point.y});
    return line;
}

int strokeUnder(const Scene& scene, int frame, const QTransform& canvasToWidget, const QPointF& position,
                double reach)
{
    int found = -1;
    const QVector<DepthStroke>& strokes = scene.depth.strokes;
    for (int i = 0; i < strokes.size(); ++i)
    {
        if (strokes[i].frame != frame || strokes[i].points.isEmpty())
            continue;
        const double distance = distanceTo(canvasToWidget.map(lineOf(strokes[i])), position);
        if (distance <= reach)
        {
            found = i;
            reach = distance;
        }
    }
    return found;
}

} // namespace lampblack
