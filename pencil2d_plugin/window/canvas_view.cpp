#include "window/canvas_view.h"

#include <QMouseEvent>
#include <QPainter>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{
constexpr double Step = 1.25; ///< of the zoom, for a notch of the wheel
constexpr double NotchUnits = 120;
constexpr double LeastZoom = 0.05;
constexpr double MostZoom = 16;
constexpr int Margin = 12; // pixels
} // namespace

CanvasView::CanvasView(QWidget* paper) : QWidget(paper)
{
    setObjectName(QStringLiteral("lampblack.window.canvas"));
    setAttribute(Qt::WA_NoSystemBackground);
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
}

void CanvasView::setPicture(const QImage& picture)
{
    mPicture = QPixmap::fromImage(picture);
    update();
}

void CanvasView::setCanvasSize(const QSize& size)
{
    if (size == mSize)
        return;
    mSize = size;
    place();
}

QTransform CanvasView::imageToWidget() const
{
    return QTransform(mZoom, 0, 0, mZoom, mCorner.x(), mCorner.y());
}

void CanvasView::fit()
{
    mFits = true;
    place();
}

void CanvasView::showActualSize()
{
    zoom(1 / (mZoom * devicePixelRatioF()), QRectF(rect()).center());
}

void CanvasView::zoomIn()
{
    zoom(Step, QRectF(rect()).center());
}

void CanvasView::zoomOut()
{
    zoom(1 / Step, QRectF(rect()).center());
}

void CanvasView::zoom(double factor, const QPointF& about)
{
    mFits = false;
    const double before = mZoom;
    mZoom = std::clamp(before * factor, LeastZoom, MostZoom);
    mCorner = about + (mCorner - about) * (mZoom / before);
    place();
}

void CanvasView::place()
{
    if (mFits)
    {
        const double across = (width() - 2.0 * Margin) / mSize.width();
        const double down = (height() - 2.0 * Margin) / mSize.height();
        mZoom = std::clamp(std::min(across, down), LeastZoom, MostZoom);
        mCorner = {std::round((width() - mZoom * mSize.width()) / 2),
                   std::round((height() - mZoom * mSize.height()) / 2)};
    }
    parentWidget()->update();
    Q_EMIT viewChanged();
}

void CanvasView::paintEvent(QPaintEvent*)
{
    if (mPicture.isNull())
        return;
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform, mZoom * devicePixelRatioF() < 2);
    painter.setTransform(imageToWidget(), true);
    painter.drawPixmap(0, 0, mPicture);
}

void CanvasView::resizeEvent(QResizeEvent* event)
{
    QWidget::resizeEvent(event);
    place();
}

void CanvasView::wheelEvent(QWheelEvent* event)
{
    zoom(std::pow(Step, event->angleDelta().y() / NotchUnits), event->position());
}

void CanvasView::mousePressEvent(QMouseEvent* event)
{
    mGrip = event->localPos() - mCorner;
}

void CanvasView::mouseMoveEvent(QMouseEvent* event)
{
    if (!event->buttons().testFlag(Qt::MiddleButton))
        return;
    mFits = false;
    mCorner = event->localPos() - mGrip;
    place();
}

Paper::Paper(QWidget* parent) : QWidget(parent), mCanvas(new CanvasView(this))
{
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(mCanvas);
}

void Paper::setHint(const QString& hint)
{
    mHint = hint;
    update();
}

void Paper::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.fillRect(rect(), palette().color(QPalette::Dark));
    if (!mHint.isEmpty())
    {
        painter.setPen(palette().color(QPalette::BrightText));
        painter.drawText(rect(), int(Qt::AlignCenter) | int(Qt::TextWordWrap), mHint);
        return;
    }
    painter.fillRect(mCanvas->imageToWidget().mapRect(QRectF(QPointF(), QSizeF(mCanvas->canvasSize()))),
                     colour());
}

} // namespace lampblack
