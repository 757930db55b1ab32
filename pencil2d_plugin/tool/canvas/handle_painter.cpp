#include "tool/canvas/handle_painter.h"

#include <QFontMetrics>
#include <QPainterPath>
#include <QtMath>

#include <cmath>

namespace lampblack
{

namespace
{

constexpr int Rays = 8;
const QColor Dark(24, 24, 28, 190);
const QColor Light(255, 255, 255, 240);
const QColor Hover(255, 206, 92);

void strokeOutlined(QPainter& painter, const QPainterPath& path, const QColor& inner, double width,
                    bool dashed = false)
{
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(Dark, width + 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPath(path);
    QPen pen(inner, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
    if (dashed)
    {
        pen.setCapStyle(Qt::FlatCap);
        pen.setDashPattern({4 / width, 4 / width});
    }
    painter.setPen(pen);
    painter.drawPath(path);
}

QPainterPath circle(const QPointF& centre, double radius)
{
    QPainterPath path;
    path.addEllipse(centre, radius, radius);
    return path;
}

QPainterPath line(const QPointF& from, const QPointF& to)
{
    QPainterPath path(from);
    path.lineTo(to);
    return path;
}

QPainterPath rays(const QPointF& centre)
{
    QPainterPath path;
    for (int ray = 0; ray < Rays; ++ray)
    {
        const double angle = 2 * M_PI * ray / Rays;
        const QPointF way(std::cos(angle), std::sin(angle));
        path.moveTo(centre + way * (Handles::DiscRadius + 3));
        path.lineTo(centre + way * Handles::RayRadius);
    }
    return path;
}

void paintArrow(QPainter& painter, const LightShape& light)
{
    const QLineF way(light.centre, light.place);
    if (way.length() < 1)
        return;
    const QPointF ahead = (way.p2() - way.p1()) / way.length();
    const QPointF aside(-ahead.y(), ahead.x());
    QPainterPath arrow(light.centre + ahead * 19);
    arrow.lineTo(light.centre + ahead * 13 + aside * 5);
    arrow.lineTo(light.centre + ahead * 13 - aside * 5);
    arrow.closeSubpath();
    painter.setPen(QPen(Dark, 1));
    painter.setBrush(Light);
    painter.drawPath(arrow);
}

void paintStem(QPainter& painter, const LightShape& light, bool selected, const QColor& tint)
{
    const double way = light.behind ? 1 : -1;
    const QPointF root = light.centre + QPointF(0, way * (Handles::DiscRadius + 2));
    strokeOutlined(painter, line(root, light.grip), tint, selected ? 1.5 : 1, light.behind);
    strokeOutlined(painter, circle(light.grip, Handles::GripRadius), tint, 1.5);
    painter.setPen(Qt::NoPen);
    painter.setBrush(light.behind ? QColor(90, 90, 96) : Light);
    painter.drawEllipse(light.grip, Handles::GripRadius - 1, Handles::GripRadius - 1);
}

void paintLight(QPainter& painter, const LightShape& light, bool selected, HandlePart hovered)
{
    const auto tint = [hovered](HandlePart part)
    {
        return hovered == part ? Hover : Light;
    };
    painter.save();
    if (!selected && hovered == HandlePart::None)
        painter.setOpacity(0.6);
    if (!light.outside)
        strokeOutlined(painter, circle(light.centre, light.ring), tint(HandlePart::Size), selected ? 1.5 : 1,
                       light.behind);
    painter.restore();
    if (!light.outside)
        paintStem(painter, light, selected, tint(HandlePart::Height));

    if (light.outside)
        paintArrow(painter, light);
    else if (!light.behind)
        strokeOutlined(painter, rays(light.centre), selected ? tint(HandlePart::Light) : light.colour, 1.5);
    if (light.behind)
    {
        strokeOutlined(painter, circle(light.centre, Handles::DiscRadius), tint(HandlePart::Light), 5);
        strokeOutlined(painter, circle(light.centre, Handles::DiscRadius), light.colour, 3, true);
        return;
    }
    strokeOutlined(painter, circle(light.centre, Handles::DiscRadius),
                   selected || hovered == HandlePart::Light ? tint(HandlePart::Light) : Light,
                   selected ? 2 : 1);
    painter.setPen(Qt::NoPen);
    painter.setBrush(light.colour);
    painter.drawEllipse(light.centre, Handles::DiscRadius - 1, Handles::DiscRadius - 1);
}

void paintPath(QPainter& painter, const LightShape& light, bool selected)
{
    if (light.path.isEmpty())
        return;
    QPainterPath way;
    way.addPolygon(light.path);
    painter.save();
    painter.setOpacity(selected ? 0.55 : 0.3);
    strokeOutlined(painter, way, Light, 1, true);
    painter.setPen(QPen(Dark, 1));
    for (int key = 0; key < light.path.size(); ++key)
    {
        painter.setBrush(key == light.key ? Hover : Light);
        painter.drawEllipse(light.path[key], Handles::KeyRadius, Handles::KeyRadius);
    }
    painter.restore();
}

void paintFloor(QPainter& painter, const FloorShape& floor, bool hovered)
{
    const QColor tint = hovered ? Hover : Light;
    QPainterPath patch;
    patch.addPolygon(floor.patch);
    patch.closeSubpath();
    // With two lines each way the patch looks like tiles of floor in perspective.
    for (int third = 1; third <= 2; ++third)
    {
        const double t = third / 3.0;
        const QPolygonF& p = floor.patch;
        patch.moveTo(QLineF(p[0], p[1]).pointAt(t));
        patch.lineTo(QLineF(p[3], p[2]).pointAt(t));
        patch.moveTo(QLineF(p[0], p[3]).pointAt(t));
        patch.lineTo(QLineF(p[1], p[2]).pointAt(t));
    }
    painter.save();
    painter.setOpacity(hovered ? 1 : 0.75);
    strokeOutlined(painter, line(floor.line.p1(), floor.line.p2()), tint, 1.5);
    painter.setBrush(QColor(0, 0, 0, 60));
    painter.setPen(Qt::NoPen);
    painter.drawPolygon(floor.patch);
    strokeOutlined(painter, patch, tint, 1);
    painter.restore();
}

} // namespace

void paintHandles(QPainter& painter, const Handles& handles, const Handle& hovered)
{
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    if (handles.floor())
        paintFloor(painter, *handles.floor(), hovered.part == HandlePart::Floor);
    for (int light = 0; light < handles.lights().size(); ++light)
        paintPath(painter, handles.lights()[light], light == handles.selected());
    const auto part = [&hovered](int light)
    {
        return hovered.light == light ? hovered.part : HandlePart::None;
    };
    for (int light = 0; light < handles.lights().size(); ++light)
    {
        if (light != handles.selected())
            paintLight(painter, handles.lights()[light], false, part(light));
    }
    if (handles.selected() >= 0 && handles.selected() < handles.lights().size())
        paintLight(painter, handles.lights()[handles.selected()], true, part(handles.selected()));
    painter.restore();
}

QRect tagBounds(const QFont& font, const QString& text, const QPointF& position, const QSize& view)
{
    const QFontMetrics metrics(font);
    QRect box(0, 0, metrics.horizontalAdvance(text) + 14, metrics.height() + 6);
    box.moveTopLeft(position.toPoint() + QPoint(20, 14));
    box.moveRight(qMin(box.right(), view.width() - 4));
    box.moveBottom(qMin(box.bottom(), view.height() - 4));
    return box;
}

void paintTag(QPainter& painter, const QString& text, const QPointF& position, const QSize& view)
{
    const QRect box = tagBounds(painter.font(), text, position, view);
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(24, 24, 28, 215));
    painter.drawRoundedRect(box, 4, 4);
    painter.setPen(Qt::white);
    painter.drawText(box, Qt::AlignCenter, text);
    painter.restore();
}

} // namespace lampblack
