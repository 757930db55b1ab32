#include "tool/canvas/lit_picture.h"

namespace lampblack
{

void LitPicture::setPicture(const LookImage& look, const QTransform& canvasToImage)
{
    mLook = look;
    mCanvasToImage = canvasToImage;
    mCache = QPixmap();
}

void LitPicture::setBackdrop(const FrameExport& backdrop)
{
    mBackdrop = backdrop;
    mCache = QPixmap();
}

void LitPicture::clear()
{
    mLook = LookImage();
    mCache = QPixmap();
}

QRect LitPicture::bounds(const QTransform& canvasToWidget) const
{
    if (isEmpty())
        return {};
    return (mCanvasToImage.inverted() * canvasToWidget)
        .mapRect(mLook.crop)
        .adjusted(-1, -1, 1, 1)
        .toAlignedRect();
}

void LitPicture::paint(QPainter& painter, const QTransform& canvasToWidget, const QSize& view,
                       double pixelRatio, const QColor& paper)
{
    const QRect area = bounds(canvasToWidget).intersected(QRect(QPoint(), view));
    if (area.isEmpty())
        return;
    if (mCache.isNull() || mCacheTransform != canvasToWidget || mCacheView != view || mCachePaper != paper ||
        !qFuzzyCompare(mCache.devicePixelRatio(), pixelRatio))
    {
        QPixmap cache((QSizeF(area.size()) * pixelRatio).toSize());
        cache.setDevicePixelRatio(pixelRatio);
        cache.fill(Qt::transparent);
        QPainter into(&cache);
        into.translate(-area.topLeft());
        draw(into, canvasToWidget, paper);
        into.end();
        mCache = cache;
        mCacheAt = area.topLeft();
        mCacheTransform = canvasToWidget;
        mCacheView = view;
        mCachePaper = paper;
    }
    painter.drawPixmap(mCacheAt, mCache);
}

void LitPicture::draw(QPainter& painter, const QTransform& canvasToWidget, const QColor& paper) const
{
    painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    painter.setTransform(mCanvasToImage.inverted() * canvasToWidget, true);
    painter.fillRect(mLook.crop, paper);
    if (!mBackdrop.image.isNull())
    {
        painter.save();
        painter.setClipRect(mLook.crop);
        painter.setTransform(mBackdrop.canvasToImage.inverted() * mCanvasToImage, true);
        painter.drawImage(QPointF(), mBackdrop.image);
        painter.restore();
    }
    painter.drawImage(mLook.crop, mLook.picture, QRectF(mLook.picture.rect()));
}

} // namespace lampblack
