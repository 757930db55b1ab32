#include "tool/canvas/lit_picture.h"

namespace lampblack
{

void LitPicture::setPicture(const PreviewImage& image, const QTransform& canvasToImage)
{
    const bool isSame = image.picture.cacheKey() == mImage.picture.cacheKey() && image.crop == mImage.crop &&
                        canvasToImage == mCanvasToImage;
    mImage = image;
    mCanvasToImage = canvasToImage;
    if (!isSame)
        mCache = QPixmap();
}

void LitPicture::setUnlitLayers(const FrameExport& below, const FrameExport& above)
{
    const auto isSame = [](const FrameExport& one, const FrameExport& other)
    {
        return one.image.cacheKey() == other.image.cacheKey() && one.canvasToImage == other.canvasToImage;
    };
    if (isSame(below, mBelow) && isSame(above, mAbove))
        return;
    mBelow = below;
    mAbove = above;
    mCache = QPixmap();
}

void LitPicture::clear()
{
    mImage = PreviewImage();
    mCache = QPixmap();
}

QRect LitPicture::bounds(const QTransform& canvasToWidget) const
{
    if (isEmpty())
        return {};
    return (mCanvasToImage.inverted() * canvasToWidget)
        .mapRect(mImage.crop)
        .adjusted(-1, -1, 1, 1)
        .toAlignedRect();
}

void LitPicture::paint(QPainter& painter, const QTransform& canvasToWidget, const QSize& view,
                       double pixelRatio, const QColor& paper)
{
    const QRect covered = bounds(canvasToWidget).intersected(QRect(QPoint(), view));
    if (covered.isEmpty())
        return;
    if (mCache.isNull() || mCacheTransform != canvasToWidget || mCacheView != view || mCachePaper != paper ||
        !qFuzzyCompare(mCache.devicePixelRatio(), pixelRatio))
    {
        QPixmap cache((QSizeF(covered.size()) * pixelRatio).toSize());
        cache.setDevicePixelRatio(pixelRatio);
        cache.fill(Qt::transparent);
        QPainter into(&cache);
        into.translate(-covered.topLeft());
        draw(into, canvasToWidget, paper);
        into.end();
        mCache = cache;
        mCachePosition = covered.topLeft();
        mCacheTransform = canvasToWidget;
        mCacheView = view;
        mCachePaper = paper;
    }
    painter.drawPixmap(mCachePosition, mCache);
}

void LitPicture::draw(QPainter& painter, const QTransform& canvasToWidget, const QColor& paper) const
{
    painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    painter.setTransform(mCanvasToImage.inverted() * canvasToWidget, true);
    painter.fillRect(mImage.crop, paper);
    drawLayers(painter, mBelow);
    painter.drawImage(mImage.crop, mImage.picture, QRectF(mImage.picture.rect()));
    drawLayers(painter, mAbove);
}

void LitPicture::drawLayers(QPainter& painter, const FrameExport& layers) const
{
    if (layers.image.isNull())
        return;
    painter.save();
    painter.setClipRect(mImage.crop);
    painter.setTransform(layers.canvasToImage.inverted() * mCanvasToImage, true);
    painter.drawImage(QPointF(), layers.image);
    painter.restore();
}

} // namespace lampblack
