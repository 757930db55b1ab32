#include "tool/canvas/light_layer.h"

namespace lampblack
{

LightLayer::LightLayer(QObject* parent) : QObject(parent)
{
    mThread.setMaxThreadCount(1);
}

LightLayer::~LightLayer()
{
    mThread.clear();
    mThread.waitForDone();
}

void LightLayer::follow(const LitPicture& picture, const QTransform& canvasToWidget, const QSize& view,
                        const QColor& paper)
{
    const QRect area = picture.bounds(canvasToWidget).intersected(QRect(QPoint(), view));
    if (!picture.knowsDrawing() || area.isEmpty())
        return;
    const QVector<qint64> content = picture.content();
    if (content == mContent && canvasToWidget == mAskedView)
        return;
    mContent = content;
    mAskedView = canvasToWidget;
    const quint64 number = ++mAsked;
    const int frame = picture.drawn().frame;
    mThread.clear();
    mThread.start(
        [this, source = picture.withoutCache(), canvasToWidget, area, paper, number, frame]
        {
            QImage lit(area.size(), QImage::Format_RGB32);
            lit.fill(paper);
            QImage drawn = lit;
            QPainter onLit(&lit);
            onLit.translate(-area.topLeft());
            source.drawLit(onLit, canvasToWidget, paper);
            onLit.end();
            QPainter onDrawn(&drawn);
            onDrawn.translate(-area.topLeft());
            source.drawPlain(onDrawn, canvasToWidget, paper);
            onDrawn.end();
            const LightRatio ratio = ratioOf(lit, drawn);
            QMetaObject::invokeMethod(
                this,
                [this, ratio, area, canvasToWidget, number, frame]
                {
                    if (number != mAsked)
                        return;
                    mRatio = ratio;
                    mFrame = frame;
                    mPosition = area.topLeft();
                    mView = canvasToWidget;
                    Q_EMIT changed();
                },
                Qt::QueuedConnection);
        });
}

void LightLayer::clear()
{
    ++mAsked;
    mContent.clear();
    mRatio = {};
}

void LightLayer::paint(QPainter& painter, const QTransform& canvasToWidget) const
{
    painter.save();
    if (canvasToWidget != mView)
        painter.setTransform(mView.inverted() * canvasToWidget, true);
    mRatio.paint(painter, mPosition);
    painter.restore();
}

} // namespace lampblack
