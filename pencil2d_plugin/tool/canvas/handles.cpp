#include "tool/canvas/handles.h"

#include "scene/timeline.h"

#include <QRegion>
#include <QtMath>

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{

constexpr double ShortestStem = 22;
constexpr double StemGrowth = 22;
constexpr double Inset = 20;
constexpr double PatchSide = 60;
constexpr double PatchFar = 0.7; // width of its far edge
constexpr double Reach = 13;
constexpr double LineReach = 6;

double distance(const QPointF& a, const QPointF& b)
{
    return QLineF(a, b).length();
}

double distance(const QPointF& point, const QLineF& line)
{
    const QPointF along = line.p2() - line.p1();
    const double square = QPointF::dotProduct(along, along);
    const double t =
        square > 0 ? std::clamp(QPointF::dotProduct(point - line.p1(), along) / square, 0.0, 1.0) : 0.0;
    return distance(point, line.pointAt(t));
}

/// The part of a line that lies inside a rectangle (Liang and Barsky).
std::optional<QLineF> clipped(const QLineF& line, const QRectF& to)
{
    double from = 0;
    double until = 1;
    const double steps[] = {-line.dx(), line.dx(), -line.dy(), line.dy()};
    const double rooms[] = {line.x1() - to.left(), to.right() - line.x1(), line.y1() - to.top(),
                            to.bottom() - line.y1()};
    for (int side = 0; side < 4; ++side)
    {
        if (qFuzzyIsNull(steps[side]))
        {
            if (rooms[side] < 0)
                return std::nullopt;
            continue;
        }
        const double t = rooms[side] / steps[side];
        if (steps[side] < 0)
            from = std::max(from, t);
        else
            until = std::min(until, t);
    }
    if (from > until)
        return std::nullopt;
    return QLineF(line.pointAt(from), line.pointAt(until));
}

LightShape shapeOf(const AreaLight& light, double unit, const QTransform& transform, const QRectF& view)
{
    LightShape shape;
    shape.place = transform.map(QPointF(light.x, light.y));
    const QRectF room = view.adjusted(Inset, Inset, -Inset, -Inset);
    shape.centre = QPointF(std::clamp(shape.place.x(), room.left(), std::max(room.left(), room.right())),
                           std::clamp(shape.place.y(), room.top(), std::max(room.top(), room.bottom())));
    shape.outside = !view.contains(shape.place);
    if (!shape.outside)
        shape.centre = shape.place;
    shape.ring = std::max(Handles::LeastRing, light.size / 2 * scaleOf(transform));
    shape.grip = shape.centre - QPointF(0, stemOfHeight(light.z, unit));
    shape.behind = light.z < 0;
    shape.colour = light.colour;
    return shape;
}

std::optional<FloorShape> shapeOf(const Floor& floor, double width, const QTransform& transform,
                                  const QRectF& view)
{
    const QLineF whole(transform.map(QPointF(0, floor.y)), transform.map(QPointF(width, floor.y)));
    const std::optional<QLineF> line = clipped(whole, view);
    if (!line || line->length() < 1)
        return std::nullopt;
    FloorShape shape;
    shape.line = *line;
    const double margin = std::min(PatchSide / 2 + 12, line->length() / 2);
    shape.grip = line->pointAt(1 - margin / line->length());
    const QPointF along = (whole.p2() - whole.p1()) / whole.length() * (PatchSide / 2);
    const QLineF down(QPointF(), transform.map(QPointF(0, 1)) - transform.map(QPointF(0, 0)));
    const QPointF deep = down.p2() / down.length() * PatchSide * std::sin(qDegreesToRadians(floor.pitch));
    // Wider towards the viewer, so that it looks like floor.
    shape.patch << shape.grip - along * PatchFar << shape.grip + along * PatchFar << shape.grip + along + deep
                << shape.grip - along + deep;
    return shape;
}

} // namespace

double stemOfHeight(double z, double unit)
{
    const double length = ShortestStem + StemGrowth * std::asinh(2 * std::abs(z) / unit);
    return z < 0 ? -length : length;
}

double heightOfStem(double stem, double unit)
{
    const double beyond = std::abs(stem) - ShortestStem;
    if (beyond <= 0)
        return 0;
    return std::copysign(unit / 2 * std::sinh(beyond / StemGrowth), stem);
}

double scaleOf(const QTransform& canvasToWidget)
{
    return std::sqrt(std::abs(canvasToWidget.determinant()));
}

Handles::Handles(const Scene& scene, int frame, int selected, const QTransform& canvasToWidget,
                 const QSize& view)
    : mSelected(selected)
{
    const QRectF room{QPointF(), QSizeF(view)};
    for (const AreaLight& light : scene.lights)
    {
        LightShape shape = shapeOf(lightAt(light, frame), defaultHeight(scene.canvas), canvasToWidget, room);
        for (const LightKey& key : inOrder(light.keys))
        {
            if (key.frame == frame)
                shape.key = shape.path.size();
            shape.path << canvasToWidget.map(QPointF(key.x, key.y));
        }
        mLights << shape;
    }
    if (scene.floor)
        mFloor = shapeOf(floorAt(*scene.floor, frame), scene.canvas.width, canvasToWidget, room);
}

Handle Handles::at(const QPointF& position) const
{
    QVector<int> order;
    for (int light = 0; light < mLights.size(); ++light)
        order.prepend(light); // the one painted last is on top
    if (mSelected >= 0 && mSelected < mLights.size())
    {
        order.removeOne(mSelected);
        order.prepend(mSelected);
    }
    for (const int light : qAsConst(order))
    {
        if (distance(position, mLights[light].centre) <= Reach)
            return {HandlePart::Light, light};
        if (!mLights[light].outside && distance(position, mLights[light].grip) <= GripRadius + LineReach)
            return {HandlePart::Height, light};
    }
    if (mFloor && (distance(position, mFloor->line) <= LineReach ||
                   mFloor->patch.containsPoint(position, Qt::OddEvenFill)))
        return {HandlePart::Floor, -1};
    if (mSelected >= 0 && mSelected < mLights.size())
    {
        const LightShape& light = mLights[mSelected];
        if (!light.outside && std::abs(distance(position, light.centre) - light.ring) <= LineReach)
            return {HandlePart::Size, mSelected};
    }
    return {};
}

QRegion Handles::region() const
{
    constexpr double Stroke = 4;
    QRegion region;
    for (const LightShape& light : mLights)
    {
        const double body = RayRadius + Stroke;
        region += QRectF(light.centre, QSizeF())
                      .united(QRectF(light.grip, QSizeF()))
                      .adjusted(-body, -body, body, body)
                      .toAlignedRect();
        const double ring = light.ring + Stroke;
        const QRect outer = QRectF(light.place, QSizeF()).adjusted(-ring, -ring, ring, ring).toAlignedRect();
        // Leave out the inside of a large ring.
        const double hollow = light.ring * M_SQRT1_2 - Stroke;
        const QRectF inner = QRectF(light.place, QSizeF()).adjusted(-hollow, -hollow, hollow, hollow);
        region += hollow > 2 * body ? QRegion(outer).subtracted(inner.toAlignedRect()) : QRegion(outer);
        for (int key = 0; key < light.path.size(); ++key)
            region += QRectF(light.path[qMax(0, key - 1)], light.path[key])
                          .normalized()
                          .adjusted(-Stroke - KeyRadius, -Stroke - KeyRadius, Stroke + KeyRadius,
                                    Stroke + KeyRadius)
                          .toAlignedRect();
    }
    if (mFloor)
    {
        region += QRectF(mFloor->line.p1(), mFloor->line.p2())
                      .normalized()
                      .adjusted(-Stroke, -Stroke, Stroke, Stroke)
                      .toAlignedRect();
        region += mFloor->patch.boundingRect().adjusted(-Stroke, -Stroke, Stroke, Stroke).toAlignedRect();
    }
    return region;
}

} // namespace lampblack
