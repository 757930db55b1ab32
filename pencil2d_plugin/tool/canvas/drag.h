// A handle that is being dragged: turns pointer positions into scenes.
#pragma once

#include "tool/canvas/handles.h"

namespace lampblack
{

/// Remembers what is dragged, as it was when the button was pressed. Positions are in widget coordinates.
class Drag
{
public:
    enum class Kind
    {
        LightPlace,
        LightHeight,
        LightSize,
        FloorPlace,
        FloorPitch
    };

    /// `handle` is a handle of `scene`, not None. The scene is changed at `frame`. With `depth` the drag
    /// changes the height of a light or the pitch of a floor.
    Drag(const Handle& handle, bool depth, const QPointF& press, const Scene& scene, int frame,
         const Handles& handles, const QTransform& canvasToWidget);

    Kind kind() const { return mKind; }
    const Handle& handle() const { return mHandle; }
    int gesture() const { return mGesture; }
    QString undoText() const;

    /// `scene` with the dragged light or floor moved to the pointer. `constrain` keeps moves horizontal or
    /// vertical on the screen, and rounds sizes and angles. If `scene` no longer has that light or floor, it
    /// is returned unchanged.
    Scene moved(const Scene& scene, const QPointF& pointer, bool constrain) const;

    /// `scene` with the dragged light or floor as it was before the drag.
    Scene restored(const Scene& scene) const;

private:
    AreaLight movedLight(const QPointF& pointer, bool constrain) const;
    Floor movedFloor(const QPointF& pointer, bool constrain) const;

    Handle mHandle;
    Kind mKind = Kind::LightPlace;
    int mGesture = 0;
    QPointF mPress;
    QPointF mCentre; ///< centre of the light's handle, or a point of the floor's hinge
    double mUnit = 1;
    QTransform mToCanvas;
    int mFrame = 0;
    AreaLight mLight; ///< with its keys
    Floor mFloor;
    AreaLight mShownLight; ///< as it was at mFrame, without keys
    Floor mShownFloor;
};

/// `scene` after the wheel was turned by `notches` (positive: away from the artist) over a handle at `frame`.
/// It changes the height of a light, also to below the paper, or the pitch of a floor. `fine` makes small
/// steps.
Scene turnedByWheel(const Scene& scene, int frame, const Handle& handle, double notches, bool fine);

} // namespace lampblack
