#include "host/camera_frame.h"

#include "host/paint_filter.h"

#include <QLineF>
#include <QPainter>

namespace lampblack
{

namespace
{

constexpr int Corners = 4;

/// Takes the first polygon with four corners.
class FrameFinder : public PaintFilter
{
public:
    QPolygonF corners;

    void drawPolygon(const QPointF* points, int count, PolygonDrawMode) override
    {
        if (!corners.isEmpty() || count < Corners)
            return;
        for (int i = 0; i < Corners; ++i)
            corners << painter()->combinedTransform().map(points[i]);
    }
};

/// From the unit square to the parallelogram with these three corners.
QTransform parallelogram(const QPointF& origin, const QPointF& right, const QPointF& below)
{
    const QPointF across = right - origin;
    const QPointF down = below - origin;
    return QTransform(across.x(), across.y(), down.x(), down.y(), origin.x(), origin.y());
}

} // namespace

std::optional<QTransform> viewOfFrame(const QPolygonF& corners, const QTransform& widget,
                                      const QSize& picture)
{
    constexpr double Tolerance = 0.01; // pixels
    if (corners.size() != Corners || !widget.isInvertible())
        return std::nullopt;
    if (QLineF(corners[0] + corners[2], corners[1] + corners[3]).length() > Tolerance)
        return std::nullopt;
    const QPolygonF frame = widget.inverted().map(corners);
    const QTransform onCanvas = parallelogram(frame[0], frame[1], frame[3]);
    if (!onCanvas.isInvertible())
        return std::nullopt;
    const QPointF corner(-(picture.width() / 2), -(picture.height() / 2));
    const QTransform view = onCanvas.inverted() * parallelogram(corner, corner + QPointF(picture.width(), 0),
                                                                corner + QPointF(0, picture.height()));
    // A camera that stands still is known as such by its view.
    return areNear(view, QTransform()) ? QTransform() : view;
}

std::optional<QTransform> readCameraFrame(QWidget* canvas, const QTransform& widget, const QSize& picture)
{
    FrameFinder finder;
    paintInto(&finder, canvas);
    return viewOfFrame(finder.corners, widget, picture);
}

} // namespace lampblack
