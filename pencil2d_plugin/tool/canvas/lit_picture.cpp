#include "tool/canvas/lit_picture.h"

namespace lampblack
{

namespace
{

bool isSame(const PreviewImage& one, const PreviewImage& other)
{
    return one.picture.cacheKey() == other.picture.cacheKey() && one.crop == other.crop;
}

QPolygonF covered(const PreviewImage& image, const QTransform& canvasToImage,
                  const QTransform& canvasToWidget)
{
    if (image.picture.isNull())
        return {};
    return (canvasToImage.inverted() * canvasToWidget).map(QPolygonF(image.crop));
}

void drawLayers(QPainter& painter, const FrameExport& layers, const QRectF& crop,
                const QTransform& canvasToImage)
{
    if (layers.image.isNull())
        return;
    painter.save();
    painter.setClipRect(crop);
    painter.setTransform(layers.canvasToImage.inverted() * canvasToImage, true);
    painter.drawImage(QPointF(), layers.image);
    painter.restore();
}

} // namespace

void LitPicture::setPicture(const PreviewImage& image, const QTransform& canvasToImage)
{
    if (!isSame(image, mImage) || canvasToImage != mCanvasToImage)
        mCache = QPixmap();
    mImage = image;
    mCanvasToImage = canvasToImage;
}

void LitPicture::setStandIn(const PreviewImage& image, const QTransform& canvasToImage)
{
    if (!isSame(image, mStandIn) || canvasToImage != mCanvasToStandIn)
        mCache = QPixmap();
    mStandIn = image;
    mCanvasToStandIn = canvasToImage;
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
    mStandIn = PreviewImage();
    mDrawn = FrameExport();
    mCache = QPixmap();
}

QRect LitPicture::bounds(const QTransform& canvasToWidget) const
{
    if (isEmpty())
        return {};
    return outline(canvasToWidget).boundingRect().adjusted(-1, -1, 1, 1).toAlignedRect();
}

QPainterPath LitPicture::outline(const QTransform& canvasToWidget) const
{
    QPainterPath outline;
    outline.setFillRule(Qt::WindingFill);
    outline.addPolygon(covered(mImage, mCanvasToImage, canvasToWidget));
    outline.addPolygon(covered(mStandIn, mCanvasToStandIn, canvasToWidget));
    return outline;
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
        drawLit(into, canvasToWidget, paper);
        into.end();
        mCache = cache;
        mCachePosition = area.topLeft();
        mCacheTransform = canvasToWidget;
        mCacheView = view;
        mCachePaper = paper;
    }
    painter.drawPixmap(mCachePosition, mCache);
}

void LitPicture::drawLit(QPainter& painter, const QTransform& canvasToWidget, const QColor& paper) const
{
    painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    draw(painter, mStandIn, mCanvasToStandIn, canvasToWidget, paper);
    draw(painter, mImage, mCanvasToImage, canvasToWidget, paper);
}

void LitPicture::drawPlain(QPainter& painter, const QTransform& canvasToWidget, const QColor& paper) const
{
    painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    PreviewImage plain;
    plain.picture = mDrawn.image;
    plain.crop = QRectF(mDrawn.image.rect());
    draw(painter, plain, mDrawn.canvasToImage, canvasToWidget, paper);
}

LitPicture LitPicture::withoutCache() const
{
    LitPicture copy = *this;
    copy.mCache = QPixmap();
    return copy;
}

QVector<qint64> LitPicture::content() const
{
    return {mImage.picture.cacheKey(), mStandIn.picture.cacheKey(), mDrawn.image.cacheKey(),
            mBelow.image.cacheKey(), mAbove.image.cacheKey()};
}

void LitPicture::draw(QPainter& painter, const PreviewImage& image, const QTransform& canvasToImage,
                      const QTransform& canvasToWidget, const QColor& paper) const
{
    if (image.picture.isNull())
        return;
    painter.save();
    painter.setTransform(canvasToImage.inverted() * canvasToWidget, true);
    painter.fillRect(image.crop, paper);
    drawLayers(painter, mBelow, image.crop, canvasToImage);
    painter.drawImage(image.crop, image.picture, QRectF(image.picture.rect()));
    drawLayers(painter, mAbove, image.crop, canvasToImage);
    painter.restore();
}

} // namespace lampblack
