// The places of the handles of lights and floor on the canvas widget.
//
// Everything here is in widget coordinates (logical pixels, y down). Handles have the same size at every
// zoom; only a light's ring shows the light's true diameter.
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
    QPointF centre;       ///< moved into the view, so that every light can be reached
    QPointF place;        ///< where the light really is
    QPointF grip;         ///< above the centre if the light is in front of the paper, otherwise below
    double ring = 0;      ///< radius
    bool behind = false;  ///< behind the paper
    bool outside = false; ///< out of view
    QColor colour;
    QPolygonF path; ///< its places at its keys, in order
    int key = -1;   ///< index of the key at this frame, or -1
};

struct FloorShape
{
    QLineF line; ///< the visible part of the hinge
    QPointF grip;
    QPolygonF patch; ///< a square of floor in perspective, to show the pitch
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
    /// The handles at `frame`.
    Handles(const Scene& scene, int frame, int selected, const QTransform& canvasToWidget, const QSize& view);

    const QVector<LightShape>& lights() const { return mLights; }
    const std::optional<FloorShape>& floor() const { return mFloor; }
    int selected() const { return mSelected; }

    /// The handle under the pointer. Only the selected light can be hit at its ring.
    Handle at(const QPointF& position) const;

    /// The region that the handles are painted on, as a few rectangles.
    QRegion region() const;

private:
    QVector<LightShape> mLights;
    std::optional<FloorShape> mFloor;
    int mSelected = -1;
};

/// Length in pixels of the stem of a light at height z; negative behind the paper. `unit` is the scene's
/// default height.
double stemOfHeight(double z, double unit);

/// The inverse of stemOfHeight(). Every length below the shortest means height 0, so that it is easy to set.
double heightOfStem(double stem, double unit);

/// The size of a canvas pixel in widget pixels.
double scaleOf(const QTransform& canvasToWidget);

} // namespace lampblack
