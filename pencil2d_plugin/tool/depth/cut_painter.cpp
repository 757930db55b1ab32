#include "tool/depth/cut_painter.h"

#include <QLineF>
#include <QPainterPath>

#include <algorithm>

namespace lampblack
{

namespace
{

constexpr double Spacing = 20; // widget pixels, as all that follows
constexpr double ToothWidth = 10;
constexpr double ToothHeight = 9;
constexpr double Width = 2;
constexpr double HoveredWidth = 4;
// Blue and orange differ for every eye, and neither is a grey of the picture.
const QColor Found(96, 190, 255);
const QColor Corrected(255, 160, 50);
const QColor Dark(24, 24, 28, 200);

void paintCut(QPainter& painter, const Cut& cut, bool isHovered, const QTransform& canvasToWidget)
{
    const QColor colour = cut.isCorrected ? Corrected : Found;
    const double width = isHovered ? HoveredWidth : Width;
    QPainterPath line;
    line.addPolygon(canvasToWidget.map(cut.line));
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(Dark, width + 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPath(line);
    QPen pen(colour, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
    if (cut.front == FrontSide::Joined)
    {
        pen.setCapStyle(Qt::FlatCap);
        pen.setDashPattern({6 / width, 5 / width});
    }
    painter.setPen(pen);
    painter.drawPath(line);
    painter.setPen(QPen(Dark, 1));
    painter.setBrush(colour);
    const QVector<QPolygonF> teeth = teethOf(cut, canvasToWidget, Spacing);
    for (const QPolygonF& tooth : teeth)
        painter.drawPolygon(tooth);
}

} // namespace

void paintCuts(QPainter& painter, const QVector<Cut>& cuts, int hovered, const QTransform& canvasToWidget)
{
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    for (int i = 0; i < cuts.size(); ++i)
    {
        if (i != hovered)
            paintCut(painter, cuts[i], false, canvasToWidget);
    }
    if (hovered >= 0 && hovered < cuts.size())
        paintCut(painter, cuts[hovered], true, canvasToWidget);
    painter.restore();
}

void paintStroke(QPainter& painter, const QPolygonF& stroke, const QTransform& canvasToWidget)
{
    if (stroke.size() > 1)
        paintCuts(painter, {{stroke, FrontSide::Left, 0, true, -1}}, 0, canvasToWidget);
}

QVector<QPolygonF> teethOf(const Cut& cut, const QTransform& canvasToWidget, double spacing)
{
    QVector<QPolygonF> teeth;
    if (cut.front == FrontSide::Joined)
        return teeth;
    // A mirrored view also mirrors the sides.
    const bool isLeft = (cut.front == FrontSide::Left) == (canvasToWidget.determinant() > 0);
    const QPolygonF line = canvasToWidget.map(cut.line);
    double next = std::min(spacing, lengthOf(line)) / 2;
    for (int i = 1; i < line.size(); ++i)
    {
        const QLineF piece(line[i - 1], line[i]);
        const double length = piece.length();
        for (; next < length; next += spacing)
        {
            const QPointF along = (piece.p2() - piece.p1()) / length;
            const QPointF left(along.y(), -along.x()); // y is down
            const QPointF foot = piece.p1() + next * along;
            teeth.append(QPolygonF({foot - along * ToothWidth / 2, foot + along * ToothWidth / 2,
                                    foot + (isLeft ? left : -left) * ToothHeight}));
        }
        next -= length;
    }
    return teeth;
}

} // namespace lampblack
