// The lit picture on its paper, aligned with the drawing.
#pragma once

#include "host/host.h"
#include "worker/worker.h"

#include <QPainter>
#include <QPainterPath>
#include <QPixmap>

namespace lampblack
{

/// Cached as a pixmap at screen resolution, so that repainting is fast.
class LitPicture
{
public:
    /// `canvasToImage` is the camera of the frame: the picture's crop is in the frame's own pixels.
    void setPicture(const PreviewImage& image, const QTransform& canvasToImage);
    /// What is shown where the picture's crop does not reach; a null picture for nothing.
    void setStandIn(const PreviewImage& image, const QTransform& canvasToImage);
    /// The unlit layers under and over the lit ones; null images for none.
    void setUnlitLayers(const FrameExport& below, const FrameExport& above);
    /// The drawing that picture and stand-in were made from; a null image if it is not known.
    void setDrawn(const FrameExport& drawn) { mDrawn = drawn; }
    const FrameExport& drawn() const { return mDrawn; }
    bool knowsDrawing() const { return !isEmpty() && !mDrawn.image.isNull(); }
    void clear();
    bool hasPicture() const { return !mImage.picture.isNull(); }
    bool isEmpty() const { return !hasPicture() && mStandIn.picture.isNull(); }
    const PreviewImage& image() const { return mImage; }

    /// The widget pixels that the picture and its stand-in cover.
    QRect bounds(const QTransform& canvasToWidget) const;
    QPainterPath outline(const QTransform& canvasToWidget) const;

    void paint(QPainter& painter, const QTransform& canvasToWidget, const QSize& view, double pixelRatio,
               const QColor& paper);

    /// All of it, on its paper, and the same place as drawn. The painter is in widget pixels.
    void drawLit(QPainter& painter, const QTransform& canvasToWidget, const QColor& paper) const;
    void drawPlain(QPainter& painter, const QTransform& canvasToWidget, const QColor& paper) const;
    /// A copy for another thread, where there are no pixmaps.
    LitPicture withoutCache() const;
    /// Equal for pictures with the same pixels.
    QVector<qint64> content() const;

private:
    void draw(QPainter& painter, const PreviewImage& image, const QTransform& canvasToImage,
              const QTransform& canvasToWidget, const QColor& paper) const;

    PreviewImage mImage;
    QTransform mCanvasToImage;
    PreviewImage mStandIn;
    QTransform mCanvasToStandIn;
    FrameExport mDrawn;
    FrameExport mBelow;
    FrameExport mAbove;

    QPixmap mCache;
    QPoint mCachePosition; ///< widget pixels
    QTransform mCacheTransform;
    QSize mCacheView;
    QColor mCachePaper;
};

} // namespace lampblack
