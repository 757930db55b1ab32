#include "tool/depth/brush_painter.h"

#include "tool/canvas/handles.h"

#include <QLineF>
#include <QPainterPath>

namespace lampblack
{

namespace
{

constexpr double Width = 2; // widget pixels, as all that follows
constexpr double HoveredWidth = 4;
constexpr double DotRadius = 3.5;
constexpr double ArrowLength = 11;
constexpr double ArrowAngle = 25; // degrees to either side
constexpr int BandAlpha = 60;
const QColor Dark(24, 24, 28, 200);

// They differ for every eye, and none is a grey of the picture.
QColor colourOf(Brush brush)
{
    switch (brush)
    {
    case Brush::Bump:
        return {255, 160, 50};
    case Brush::Dent:
        return {96, 190, 255};
    case Brush::Turn:
        return {190, 130, 255};
    case Brush::Round:
        return {255, 220, 90};
    case Brush::Hollow:
        return {90, 225, 190};
    }
    return {};
}

QPainterPath pathOf(const QPolygonF& line, bool hasArrow)
{
    QPainterPath path;
    if (line.size() == 1)
    {
        path.addEllipse(line.first(), DotRadius, DotRadius);
        return path;
    }
    path.addPolygon(line);
    QLineF back(line.last(), line[line.size() - 2]);
    if (!hasArrow || back.length() <= 0)
        return path;
    for (const double turn : {-ArrowAngle, ArrowAngle})
    {
        QLineF barb = back;
        barb.setLength(ArrowLength);
        barb.setAngle(back.angle() + turn);
        path.moveTo(barb.p1());
        path.lineTo(barb.p2());
    }
    return path;
}

void paintLine(QPainter& painter, const QPolygonF& line, Brush brush, double width)
{
    if (line.isEmpty())
        return;
    const QPainterPath path = pathOf(line, brush == Brush::Turn);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(Dark, width + 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPath(path);
    painter.setPen(QPen(colourOf(brush), width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPath(path);
}

void paintReach(QPainter& painter, const QPointF& at, double radius, Brush brush)
{
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(Dark, Width + 2));
    painter.drawEllipse(at, radius, radius);
    painter.setPen(QPen(colourOf(brush), Width));
    painter.drawEllipse(at, radius, radius);
}

} // namespace

void paintBrush(QPainter& painter, const BrushView& view, const QTransform& canvasToWidget)
{
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    // What is said of a whole part has no radius.
    const bool bends = view.brush.brush == Brush::Round || view.brush.brush == Brush::Hollow;
    const double radius = bends ? DotRadius : view.brush.radius * scaleOf(canvasToWidget);
    for (int i = 0; i < view.strokes.size(); ++i)
        paintLine(painter, canvasToWidget.map(lineOf(view.strokes[i])), view.strokes[i].brush,
                  i == view.hovered ? HoveredWidth : Width);
    if (!view.drawn.isEmpty())
    {
        const QPolygonF drawn = canvasToWidget.map(view.drawn);
        QColor band = colourOf(view.brush.brush);
        band.setAlpha(BandAlpha);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(band, 2 * radius, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
        if (drawn.size() > 1)
            painter.drawPolyline(drawn);
        else
            painter.drawPoint(drawn.first());
        paintLine(painter, drawn, view.brush.brush, HoveredWidth);
    }
    if (view.pointer)
        paintReach(painter, canvasToWidget.map(*view.pointer), radius, view.brush.brush);
    painter.restore();
}

} // namespace lampblack
