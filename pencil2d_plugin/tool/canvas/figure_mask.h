// Which part of a drawing is a figure, told without the worker: what is drawn, and what lines enclose.
#pragma once

#include <QImage>
#include <QSize>
#include <QVector>

namespace lampblack
{

using Pixel = const uchar*; ///< four bytes, the last of them alpha, the others in any order

bool isDrawn(Pixel pixel);

Pixel pixelOf(const QImage& image, int x, int y);

/// All corners are painted, and alike.
bool isOnGround(const QImage& image);

/// 1 where anything is drawn in an element, of `step` pixels, of a grid over the image. On a ground, only
/// what differs from its colour.
QVector<char> drawnElements(const QImage& image, const QSize& size, double step, bool onGround);

/// 1 where no way over bare elements leads in from the image's edge.
QVector<char> enclosedBy(const QVector<char>& drawn, const QSize& size);

} // namespace lampblack
