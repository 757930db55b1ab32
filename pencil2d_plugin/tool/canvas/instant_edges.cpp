#include "tool/canvas/instant_edges.h"

#include "tool/canvas/figure_mask.h"

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{

constexpr int LongSide = 512;        ///< elements
constexpr double WidestLine = 0.04;  ///< of the longer side
constexpr float Diagonal = 1.41421F; ///< from an element to the next

/// For each element of `inside` about how far the nearest one is that is not, in elements; 0 for those. What
/// is beyond the image's edge does not count.
QVector<float> depthWithin(const QVector<char>& inside, const QSize& size)
{
    const int width = size.width();
    const int height = size.height();
    const auto far = float(width + height);
    QVector<float> depth(inside.size());
    for (int at = 0; at < depth.size(); ++at)
        depth[at] = inside[at] != 0 ? far : 0;
    float* found = depth.data();
    const auto sweep = [&](int x, int y, int by)
    {
        float& here = found[y * width + x];
        const bool hasBeside = x - by >= 0 && x - by < width;
        const bool hasAhead = x + by >= 0 && x + by < width;
        const bool hasRow = y - by >= 0 && y - by < height;
        const float* row = found + (y - by) * width;
        if (hasBeside)
            here = std::min(here, found[y * width + x - by] + 1);
        if (hasRow)
            here = std::min(here, row[x] + 1);
        if (hasRow && hasBeside)
            here = std::min(here, row[x - by] + Diagonal);
        if (hasRow && hasAhead)
            here = std::min(here, row[x + by] + Diagonal);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            sweep(x, y, 1);
    for (int y = height - 1; y >= 0; --y)
        for (int x = width - 1; x >= 0; --x)
            sweep(x, y, -1);
    return depth;
}

/// What is drawn; of line art, what lines enclose too.
QVector<char> figureOf(const QImage& image)
{
    QVector<char> drawn = drawnElements(image, image.size(), 1, isOnGround(image));
    const QVector<char> whole = enclosedBy(drawn, image.size());
    return 2 * drawn.count(1) > whole.count(1) ? drawn : whole;
}

/// Usual width of the dark line along the silhouette, in elements; 0: there is none.
/// `depth` is that within `figure`.
float outlineWidth(const QVector<char>& figure, const QVector<float>& depth, const QVector<char>& dark,
                   const QSize& size)
{
    QVector<char> unpainted(figure.size());
    for (int at = 0; at < figure.size(); ++at)
        unpainted[at] = figure[at] != 0 && dark[at] == 0 ? 0 : 1;
    const QVector<float> toPaint = depthWithin(unpainted, size);
    QVector<float> widths;
    for (int at = 0; at < figure.size(); ++at)
        if (dark[at] != 0 && depth[at] > 0 && depth[at] <= 1)
            widths.append(toPaint[at]);
    if (widths.isEmpty())
        return 0;
    std::nth_element(widths.begin(), widths.begin() + widths.size() / 2, widths.end());
    const float width = widths[widths.size() / 2];
    return width > WidestLine * std::max(size.width(), size.height()) ? 0 : width;
}

/// The nearest inner edge of each element.
class InnerEdges
{
public:
    explicit InnerEdges(const QSize& size)
        : mSize(size), mNearest(size.width() * size.height(), float(size.width() + size.height())),
          mIsFront(mNearest.size(), 0)
    {
    }

    /// Measure the elements beside `edge`, which is in elements.
    void add(const InnerEdge& edge)
    {
        for (int i = 1; i < edge.line.size(); ++i)
        {
            const QPointF begin = edge.line[i - 1];
            const QPointF along = edge.line[i] - begin;
            const double length = std::hypot(along.x(), along.y());
            if (length <= 0)
                continue;
            const QPointF way = along / length;
            const QPointF left(way.y(), -way.x());
            const QRect around = QRectF(begin, edge.line[i])
                                     .normalized()
                                     .adjusted(-Beside, -Beside, Beside, Beside)
                                     .toAlignedRect()
                                     .intersected(QRect(QPoint(), mSize));
            for (int y = around.top(); y <= around.bottom(); ++y)
            {
                for (int x = around.left(); x <= around.right(); ++x)
                {
                    const QPointF place = QPointF(x + 0.5, y + 0.5) - begin;
                    const double past = QPointF::dotProduct(place, way);
                    const double side = QPointF::dotProduct(place, left);
                    if (past >= -Beside / 2 && past <= length + Beside / 2 && std::abs(side) <= Beside)
                        take(y * mSize.width() + x, float(std::abs(side)), (side > 0) == edge.isFrontLeft);
                }
            }
        }
    }

    /// Shorten `depth` to the inner edges. They are in the middle of lines of ink of a width of `line`.
    void shorten(QVector<float>& depth, float line)
    {
        spread();
        for (int at = 0; at < depth.size(); ++at)
            if (mIsFront[at] != 0)
                depth[at] = std::min(depth[at], std::max(0.0F, mNearest[at] - line / 2));
    }

private:
    static constexpr double Beside = 1.5; ///< elements

    void take(int at, float distance, bool isFront)
    {
        if (distance >= mNearest[at])
            return;
        mNearest[at] = distance;
        mIsFront[at] = isFront ? 1 : 0;
    }

    /// About how far all others are, and on which side.
    void spread()
    {
        const int width = mSize.width();
        const int height = mSize.height();
        const auto sweep = [&](int x, int y, int by)
        {
            const int at = y * width + x;
            const auto from = [&](int other, float away)
            {
                if (mNearest.at(other) + away < mNearest.at(at))
                    take(at, mNearest.at(other) + away, mIsFront.at(other) != 0);
            };
            const bool hasBeside = x - by >= 0 && x - by < width;
            const bool hasAhead = x + by >= 0 && x + by < width;
            const bool hasRow = y - by >= 0 && y - by < height;
            const int row = at - by * width;
            if (hasBeside)
                from(at - by, 1);
            if (hasRow)
                from(row, 1);
            if (hasRow && hasBeside)
                from(row - by, Diagonal);
            if (hasRow && hasAhead)
                from(row + by, Diagonal);
        };
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                sweep(x, y, 1);
        for (int y = height - 1; y >= 0; --y)
            for (int x = width - 1; x >= 0; --x)
                sweep(x, y, -1);
    }

    QSize mSize;
    QVector<float> mNearest; ///< elements
    QVector<char> mIsFront;  ///< 1: it is on the part in front
};

/// Smoothed a little: the silhouette has steps of an element.
QVector<float> smoothed(const QVector<float>& plane, const QSize& size)
{
    QVector<float> found(plane.size());
    const auto along =
        [&](const QVector<float>& from, QVector<float>& to, int step, int count, int stride, int lines)
    {
        for (int line = 0; line < lines; ++line)
        {
            for (int i = 0; i < count; ++i)
            {
                const int at = line * stride + i * step;
                const float before = from[i > 0 ? at - step : at];
                const float after = from[i + 1 < count ? at + step : at];
                to[at] = (before + 2 * from[at] + after) / 4;
            }
        }
    };
    QVector<float> rows(plane.size());
    along(plane, rows, 1, size.width(), size.width(), size.height());
    along(rows, found, size.width(), size.height(), 1, size.width());
    return found;
}

} // namespace

InstantEdges edgesOf(const QImage& drawing, const QVector<InnerEdge>& inner)
{
    InstantEdges edges;
    if (drawing.isNull())
        return edges;
    edges.step = std::max(1.0, double(std::max(drawing.width(), drawing.height())) / LongSide);
    edges.size = QSize(std::max(1, int(std::lround(drawing.width() / edges.step))),
                       std::max(1, int(std::lround(drawing.height() / edges.step))));
    const QImage image = drawing.scaled(edges.size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                             .convertToFormat(QImage::Format_RGBA8888);
    const QVector<char> figure = figureOf(image);
    QVector<char> dark(figure.size(), 0);
    for (int y = 0; y < image.height(); ++y)
    {
        for (int x = 0; x < image.width(); ++x)
        {
            const Pixel pixel = pixelOf(image, x, y);
            dark[edges.at(x, y)] =
                isDrawn(pixel) && std::max({pixel[0], pixel[1], pixel[2]}) < DarkestPaint ? 1 : 0;
        }
    }
    QVector<float> depth = depthWithin(figure, edges.size);
    const float line = outlineWidth(figure, depth, dark, edges.size);
    if (line > 0)
    {
        QVector<char> inside = figure;
        for (int at = 0; at < inside.size(); ++at)
            if (dark[at] != 0 && depth[at] <= line + 1)
                inside[at] = 0;
        depth = depthWithin(inside, edges.size);
    }
    if (!inner.isEmpty())
    {
        InnerEdges nearest(edges.size);
        for (InnerEdge edge : inner)
        {
            for (QPointF& point : edge.line)
                point /= edges.step;
            nearest.add(edge);
        }
        nearest.shorten(depth, line);
    }
    for (float& distance : depth)
        distance = std::max(0.0F, distance - 0.5F) * float(edges.step);
    edges.distance = smoothed(depth, edges.size);
    return edges;
}

} // namespace lampblack
