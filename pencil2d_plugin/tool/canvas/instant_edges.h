// How far what is drawn is from the edge of its figure, or of the part that it is on.
#pragma once

#include <QImage>
#include <QPolygonF>
#include <QSize>
#include <QVector>

namespace lampblack
{

/// A grid over an image, row 0 at the top.
struct InstantEdges
{
    QSize size;              ///< elements
    double step = 1;         ///< image pixels that an element is wide and high
    QVector<float> distance; ///< image pixels; 0 outside the figure and on its outline

    bool isEmpty() const { return distance.isEmpty(); }
    int at(int x, int y) const { return y * size.width() + x; }
};

/// A line along which one part of the figure is in front of another.
struct InnerEdge
{
    QPolygonF line;          ///< image pixels
    bool isFrontLeft = true; ///< as seen by a walker from the first point to the last
};

/// The distance to the silhouette of a drawing (any format with alpha), or to a line beside the part in
/// front, from the inner side of a dark outline. A drawing alone does not tell its inner edges.
InstantEdges edgesOf(const QImage& drawing, const QVector<InnerEdge>& inner = {});

/// Largest channel of a colour that is as dark as a line, of 255.
constexpr int DarkestPaint = 80;

} // namespace lampblack
