#include "tool/depth/cuts.h"

#include <QLineF>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lampblack
{

namespace
{

// Shares of the canvas's longer side. What is found moves a little when the surface is made anew.
constexpr double SamePlace = 0.012;
constexpr double SamePlaceOfHints = 0.03;

template <class Point> QPolygonF lineOf(const QVector<Point>& points)
{
    QPolygonF line;
    for (const Point& point : points)
        line.append({point.x, point.y});
    return line;
}

double distanceToPiece(const QPointF& from, const QPointF& to, const QPointF& point)
{
    const QPointF along = to - from;
    const double length2 = QPointF::dotProduct(along, along);
    const double t = length2 > 0 ? QPointF::dotProduct(point - from, along) / length2 : 0;
    return QLineF(from + std::clamp(t, 0.0, 1.0) * along, point).length();
}

/// Whether most of `line` lies along `other`.
bool liesAlong(const QPolygonF& line, const QPolygonF& other, double reach)
{
    const auto near = std::count_if(line.begin(), line.end(),
                                    [&](const QPointF& point) { return distanceTo(other, point) <= reach; });
    return 2 * near > line.size();
}

/// The point between `first` and `last` that is farthest from the straight line between them.
std::pair<int, double> farthest(const QPolygonF& line, int first, int last)
{
    std::pair<int, double> found{-1, -1};
    for (int i = first + 1; i < last; ++i)
    {
        const double distance = distanceToPiece(line[first], line[last], line[i]);
        if (distance > found.second)
            found = {i, distance};
    }
    return found;
}

} // namespace

QVector<Cut> cutsAt(const Scene& scene, int frame, const QVector<Overlap>& overlaps)
{
    QVector<Cut> cuts;
    for (int i = 0; i < scene.depth.hints.size(); ++i)
    {
        const DepthHint& hint = scene.depth.hints[i];
        if (hint.frame == frame && hint.points.size() > 1)
            cuts.append({lineOf(hint.points), hint.front, 0, true, i});
    }
    const int hints = cuts.size();
    const double side = std::max(scene.canvas.width, scene.canvas.height);
    for (const Overlap& overlap : overlaps)
    {
        const Cut found{lineOf(overlap.points), overlap.front, overlap.amount, overlap.hinted, -1};
        if (found.line.size() < 2)
            continue;
        const double reach = side * (overlap.hinted ? SamePlaceOfHints : SamePlace);
        auto* const end = cuts.begin() + hints;
        auto* const same = std::find_if(cuts.begin(), end,
                                        [&](const Cut& hint) {
                                            return liesAlong(found.line, hint.line, reach) ||
                                                   liesAlong(hint.line, found.line, reach);
                                        });
        if (same == end)
            cuts.append(found);
        else
            same->amount = std::max(same->amount, found.amount);
    }
    return cuts;
}

int cutUnder(const QVector<Cut>& cuts, const QTransform& canvasToWidget, const QPointF& position,
             double reach)
{
    int found = -1;
    for (int i = 0; i < cuts.size(); ++i)
    {
        const double distance = distanceTo(canvasToWidget.map(cuts[i].line), position);
        if (distance <= reach)
        {
            found = i;
            reach = distance;
        }
    }
    return found;
}

double distanceTo(const QPolygonF& line, const QPointF& point)
{
    if (line.size() == 1)
        return QLineF(line.first(), point).length();
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 1; i < line.size(); ++i)
        nearest = std::min(nearest, distanceToPiece(line[i - 1], line[i], point));
    return nearest;
}

double lengthOf(const QPolygonF& line)
{
    double length = 0;
    for (int i = 1; i < line.size(); ++i)
        length += QLineF(line[i - 1], line[i]).length();
    return length;
}

QPolygonF simplified(const QPolygonF& line, int most)
{
    // Ramer, Douglas and Peucker's method, the farthest point first.
    QVector<int> kept{0, line.size() - 1};
    while (line.size() > 2 && kept.size() < most)
    {
        std::pair<int, double> best{-1, 0};
        for (int i = 1; i < kept.size(); ++i)
        {
            const auto found = farthest(line, kept[i - 1], kept[i]);
            if (found.second > best.second)
                best = found;
        }
        if (best.first < 0)
            break;
        kept.insert(std::upper_bound(kept.begin(), kept.end(), best.first), best.first);
    }
    if (line.size() < 2)
        return line;
    QPolygonF result;
    for (const int i : qAsConst(kept))
        result.append(line[i]);
    return result;
}

} // namespace lampblack
