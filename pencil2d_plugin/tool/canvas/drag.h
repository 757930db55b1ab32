// A handle that is being dragged: pointer positions in, scenes out.
#pragma once

#include "tool/canvas/handles.h"

namespace lampblack
{

/// What moves, from where it was when the button went down. Positions are in widget coordinates.
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

    /// `handle` is not None and of `scene`, which is changed as it is at `frame`. With `depth` a light
    /// changes height and a floor its pitch.
    Drag(const Handle& handle, bool depth, const QPointF& press, const Scene& scene, int frame,
         const Handles& handles, const QTransform& canvasToWidget);

    Kind kind() const { return mKind; }
    const Handle& handle() const { return mHandle; }
    int gesture() const { return mGesture; }
    QString text() const;

    /// `scene` with what is dragged moved to the pointer. `constrain` keeps moves level or upright on the
    /// screen and sizes and angles round. A scene that has lost what is dragged comes back as it was.
    Scene moved(const Scene& scene, const QPointF& pointer, bool constrain) const;

    /// `scene` with what is dragged back where it was.
    Scene restored(const Scene& scene) const;

private:
    AreaLight movedLight(const QPointF& pointer, bool constrain) const;
    Floor movedFloor(const QPointF& pointer, bool constrain) const;

    Handle mHandle;
    Kind mKind = Kind::LightPlace;
    int mGesture = 0;
    QPointF mPress;
    QPointF mCentre; ///< of the light's handle, or a point of the floor's hinge
    double mUnit = 1;
    QTransform mToCanvas;
    int mFrame = 0;
    AreaLight mLight; ///< with its keys
    Floor mFloor;
    AreaLight mShownLight; ///< as it was at the frame
    Floor mShownFloor;
};

/// `scene` after `notches` of the wheel (away from the artist is above 0) over a handle at `frame`: a light
/// rises, sinks through the paper and behind it; a floor pitches. `fine` makes small steps.
Scene turned(const Scene& scene, int frame, const Handle& handle, double notches, bool fine);

} // namespace lampblack
