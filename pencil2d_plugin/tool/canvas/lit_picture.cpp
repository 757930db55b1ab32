#include "tool/canvas/lit_picture.h"

namespace lampblack
{

void LitPicture::setPicture(const LookImage& look, const QTransform& canvasToImage)
{
    mLook = look;
    mCanvasToImage = canvasToImage;
    mCache = QPixmap();
}

void LitPicture::setSurroundings(const FrameExport& below, const FrameExport& above)
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
    drawUnlit(painter, mBelow);
    painter.drawImage(mLook.crop, mLook.picture, QRectF(mLook.picture.rect()));
    drawUnlit(painter, mAbove);
}

void LitPicture::drawUnlit(QPainter& painter, const FrameExport& plate) const
{
    if (plate.image.isNull())
        return;
    painter.save();
    painter.setClipRect(mLook.crop);
    painter.setTransform(plate.canvasToImage.inverted() * mCanvasToImage, true);
    painter.drawImage(QPointF(), plate.image);
    painter.restore();
}

} // namespace lampblack
