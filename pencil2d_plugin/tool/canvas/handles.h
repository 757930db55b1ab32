// Where the handles of lights and floor stand on the canvas widget.
//
// Everything here is in widget coordinates (logical pixels, y down). Handles keep their size on screen
// at every zoom; only a light's ring shows its true diameter.
#pragma once

#include "scene/scene.h"

#include <QLineF>
#include <QPolygonF>
#include <QRectF>
#include <QTransform>
#include <QVector>

#include <optional>

namespace lampblack
{

enum class HandlePart
{
    None,
    Light,
    Height, ///< the grip at the end of a light's stem
    Size,   ///< a light's ring
    Floor
};

struct Handle
{
    HandlePart part = HandlePart::None;
    int light = -1;
};

inline bool operator==(const Handle& a, const Handle& b)
{
    return a.part == b.part && a.light == b.light;
}
inline bool operator!=(const Handle& a, const Handle& b)
{
    return !(a == b);
}

struct LightShape
{
    QPointF centre;       ///< kept inside the view, so that no light is out of reach
    QPointF place;        ///< where the light really is
    QPointF grip;         ///< above the light: in front of the paper; below it: behind
    double ring = 0;      ///< radius
    bool behind = false;  ///< behind the paper
    bool outside = false; ///< out of view
    QColor colour;
    QPolygonF path; ///< where it is at each of its keys, in their order
    int key = -1;   ///< which of them is of this frame
};

struct FloorShape
{
    QLineF line; ///< the hinge, as far as it is in view
    QPointF grip;
    QPolygonF patch; ///< a square of floor as the pitch shows it
};

class Handles
{
public:
    static constexpr double DiscRadius = 8;
    static constexpr double RayRadius = 14;
    static constexpr double GripRadius = 4.5;
    static constexpr double LeastRing = 18;
    static constexpr double KeyRadius = 3.5; ///< of the dots on a light's path

    Handles() = default;
    /// As they are at `frame`.
    Handles(const Scene& scene, int frame, int selected, const QTransform& canvasToWidget, const QSize& view);

    const QVector<LightShape>& lights() const { return mLights; }
    const std::optional<FloorShape>& floor() const { return mFloor; }
    int selected() const { return mSelected; }

    /// The handle under the pointer. The ring answers for the selected light only.
    Handle at(const QPointF& position) const;

    /// What the handles paint on, as few rectangles.
    QRegion region() const;

private:
    QVector<LightShape> mLights;
    std::optional<FloorShape> mFloor;
    int mSelected = -1;
};

/// Length of the stem of a light at height z, pixels; below 0 behind the paper. `unit` is the scene's
/// default height.
double stemOfHeight(double z, double unit);

/// The other way round; the shortest stems all mean the paper itself, a detent to pass through.
double heightOfStem(double stem, double unit);

/// How many widget pixels a canvas pixel is.
double scaleOf(const QTransform& canvasToWidget);

} // namespace lampblack
