// How far what is drawn is from the edge of its figure, told from the drawing alone.
#pragma once

#include <QImage>
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

/// The distance to the silhouette of a drawing (any format with alpha), from the inner side of a dark
/// outline. Edges between parts of the figure are not known.
InstantEdges edgesOf(const QImage& drawing);

/// Largest channel of a colour that is as dark as a line, of 255.
constexpr int DarkestPaint = 80;

} // namespace lampblack
