// The canvas of the window: the drawing without light. The lamp paints over it.
#pragma once

#include <QPixmap>
#include <QTransform>
#include <QWidget>

namespace lampblack
{

/// The wheel zooms, the middle button moves. Until the artist does so, the whole picture is in sight.
class CanvasView : public QWidget
{
    Q_OBJECT
    Q_PROPERTY(QTransform imageToWidget READ imageToWidget) ///< for tests

public:
    explicit CanvasView(QWidget* paper);

    void setPicture(const QImage& picture);
    void setCanvasSize(const QSize& size);
    QSize canvasSize() const { return mSize; }
    QTransform imageToWidget() const;

public Q_SLOTS:
    void fit();
    void showActualSize();
    void zoomIn();
    void zoomOut();

Q_SIGNALS:
    void viewChanged();

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;

private:
    void zoom(double factor, const QPointF& about);
    void place();

    QPixmap mPicture;
    QSize mSize{800, 600};
    double mZoom = 1;
    QPointF mCorner; ///< of the picture
    QPointF mGrip;   ///< where the middle button holds it
    bool mFits = true;
};

/// What lies under the drawing: the paper, and what is around it. It is a widget of its own, because the
/// canvas shows nothing where nothing is drawn.
class Paper : public QWidget
{
    Q_OBJECT

public:
    explicit Paper(QWidget* parent = nullptr);

    CanvasView& canvas() { return *mCanvas; }
    /// In place of a drawing.
    void setHint(const QString& hint);
    static QColor colour() { return Qt::white; }

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    CanvasView* mCanvas;
    QString mHint;
};

} // namespace lampblack
