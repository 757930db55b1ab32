// A guess at the surface of a drawing, made in a few milliseconds: its figure, blown up like a balloon.
#pragma once

#include <QImage>
#include <QSize>
#include <QVector>

namespace lampblack
{

/// A coarse grid over an image, row 0 at the top.
struct InstantShape
{
    QSize size;      ///< elements
    double step = 1; ///< image pixels that an element is wide and high

    QVector<char> figure;   ///< 1: the element belongs to the character
    QVector<char> enclosed; ///< 1: so do all its neighbours, and what is bare here is part of it
    bool onGround = false;  ///< the drawing has a painted ground: only the figure is lit
    /// Unit normals of the figure's elements; x right, y *down*, z to the viewer.
    QVector<float> nx;
    QVector<float> ny;
    QVector<float> nz;
    QVector<float> height; ///< above the paper, image pixels

    int count() const { return size.width() * size.height(); }
    bool isEmpty() const { return !figure.contains(1); }
};

/// The shape of a drawing (any format with alpha). The figure is what is drawn and what lines enclose; if the
/// corners of the drawing are painted, what differs from their colour. Bare paper is part of a figure only if
/// most of that is bare. Its height is the square root of the
/// solution u of the Poisson equation, laplace u = -4, with u = 0 around it: the figure of a disc is exactly
/// half a ball. Where the image ends the surface goes on level.
InstantShape inflateFigure(const QImage& drawing);

/// Give the shape of a drawing the normals of its real surface: `picture` is as in Worker::normalsArrived().
/// Elements where it has none keep theirs.
void takeNormals(InstantShape& shape, const QImage& picture);

} // namespace lampblack
