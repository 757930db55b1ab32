// Sees what a widget of the program paints, stroke by stroke.
#pragma once

#include <QPaintEngine>
#include <QWidget>

namespace lampblack
{

/// Paints nothing. Derived classes take what they look for.
class PaintFilter : public QPaintEngine
{
public:
    PaintFilter() : QPaintEngine(AllFeatures) {}

    bool begin(QPaintDevice*) override { return true; }
    bool end() override { return true; }
    void updateState(const QPaintEngineState&) override {}
    Type type() const override { return User; }

    void drawPixmap(const QRectF&, const QPixmap&, const QRectF&) override {}
    void drawTiledPixmap(const QRectF&, const QPixmap&, const QPointF&) override {}
    void drawImage(const QRectF&, const QImage&, const QRectF&, Qt::ImageConversionFlags) override {}
    void drawPath(const QPainterPath&) override {}
    void drawPolygon(const QPointF*, int, PolygonDrawMode) override {}
    void drawLines(const QLineF*, int) override {}
    void drawTextItem(const QPointF&, const QTextItem&) override {}
};

/// Let `widget` paint itself, without its children, into `filter`, in logical pixels.
void paintInto(PaintFilter* filter, QWidget* widget);

} // namespace lampblack
