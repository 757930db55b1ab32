// The flat colour under the pointer, from the last exported frame.
#pragma once

#include "host/host.h"
#include "worker/worker.h"

#include <QPointF>

namespace lampblack
{

class FrameColours
{
public:
    void setFrame(const FrameExport& frame) { mFrame = frame; }
    void setSwatches(const QVector<Swatch>& swatches);
    const FrameExport& frame() const { return mFrame; }

    /// The swatch at a point of the canvas as "#rrggbb", or an empty string where nothing is drawn. On ink
    /// and between colours it is the nearest swatch.
    QString at(const QPointF& canvas) const;

    /// Around all that is drawn, canvas pixels; empty if that is everything, as on painted paper, or nothing.
    QRectF drawnBox() const;

private:
    FrameExport mFrame;
    QVector<QRgb> mSwatches;
};

} // namespace lampblack
