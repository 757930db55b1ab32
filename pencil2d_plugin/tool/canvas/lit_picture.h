// The lit picture on its paper, registered to the drawing.
#pragma once

#include "host/host.h"
#include "worker/worker.h"

#include <QPainter>
#include <QPixmap>

namespace lampblack
{

/// Kept as a pixmap of the screen's own pixels, so that a repaint costs a blit.
class LitPicture
{
public:
    /// `canvasToImage` is the camera of the frame: the picture's crop is in the frame's own pixels.
    void setPicture(const LookImage& look, const QTransform& canvasToImage);
    /// What lies under and over what is lit: the layers that are not. Null images for none.
    void setSurroundings(const FrameExport& below, const FrameExport& above);
    void clear();
    bool isEmpty() const { return mLook.picture.isNull(); }
    const LookImage& look() const { return mLook; }

    /// Widget pixels that it covers.
    QRect bounds(const QTransform& canvasToWidget) const;

    void paint(QPainter& painter, const QTransform& canvasToWidget, const QSize& view, double pixelRatio,
               const QColor& paper);

private:
    void draw(QPainter& painter, const QTransform& canvasToWidget, const QColor& paper) const;
    void drawUnlit(QPainter& painter, const FrameExport& plate) const;

    LookImage mLook;
    QTransform mCanvasToImage;
    FrameExport mBelow;
    FrameExport mAbove;

    QPixmap mCache;
    QPoint mCacheAt; ///< widget pixels
    QTransform mCacheTransform;
    QSize mCacheView;
    QColor mCachePaper;
};

} // namespace lampblack
