// How lit pixels differ from drawn ones, so that the same light can be put on what is drawn next.
#pragma once

#include <QImage>
#include <QPainter>

namespace lampblack
{

/// What drawn pixels are multiplied by: `darker` where that is at most 1, `brighter` where it is more. Both
/// are Format_RGB32. Their values are those of two composition modes of QPainter, multiply and colour dodge,
/// and neutral (white, black) where the other counts.
struct LightRatio
{
    QImage darker;
    QImage brighter; ///< null if nothing is brighter

    bool isNull() const { return darker.isNull(); }
    /// Put the light on what `painter` has painted so far.
    void paint(QPainter& painter, const QPointF& at) const;
};

/// The light that makes `drawn` look like `lit` (Format_RGB32, of equal size). It is averaged over a few
/// pixels. Where the drawing is too dark to tell, as in a line of ink, it is that of its surroundings.
LightRatio ratioOf(const QImage& lit, const QImage& drawn);

} // namespace lampblack
