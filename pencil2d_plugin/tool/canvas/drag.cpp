#include "tool/canvas/drag.h"

#include "scene/timeline.h"
#include "tool/gesture.h"

#include <QCoreApplication>
#include <QLineF>

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{

constexpr double DegreesPerPixel = 0.5;
constexpr double DegreesPerNotch = 2.5;
constexpr double HeightPerNotch = 1.0 / 12; // of the default height
constexpr double Fine = 0.2;

Drag::Kind kindOf(HandlePart part, bool depth)
{
    switch (part)
    {
    case HandlePart::Height:
        return Drag::Kind::LightHeight;
    case HandlePart::Size:
        return Drag::Kind::LightSize;
    case HandlePart::Floor:
        return depth ? Drag::Kind::FloorPitch : Drag::Kind::FloorPlace;
    case HandlePart::Light:
    case HandlePart::None:
        break;
    }
    return depth ? Drag::Kind::LightHeight : Drag::Kind::LightPlace;
}

double roundTo(double value, double step)
{
    return std::round(value / step) * step;
}

} // namespace

Drag::Drag(const Handle& handle, bool depth, const QPointF& press, const Scene& scene, int frame,
           const Handles& handles, const QTransform& canvasToWidget)
    : mHandle(handle), mKind(kindOf(handle.part, depth)), mGesture(newGesture()), mPress(press),
      mUnit(defaultHeight(scene.canvas)), mToCanvas(canvasToWidget.inverted()), mFrame(frame)
{
    if (handle.part == HandlePart::Floor)
    {
        mFloor = scene.floor.value_or(Floor());
        mShownFloor = floorAt(mFloor, frame);
        mCentre = canvasToWidget.map(QPointF(mToCanvas.map(press).x(), mShownFloor.y));
    }
    else
    {
        mLight = scene.lights.value(handle.light);
        mShownLight = lightAt(mLight, frame);
        mCentre = handles.lights().value(handle.light).centre;
    }
}

QString Drag::undoText() const
{
    switch (mKind)
    {
    case Kind::LightHeight:
        return QCoreApplication::translate("lampblack", "Change Light Height");
    case Kind::LightSize:
        return QCoreApplication::translate("lampblack", "Change Light Size");
    case Kind::FloorPlace:
        return QCoreApplication::translate("lampblack", "Move Floor");
    case Kind::FloorPitch:
        return QCoreApplication::translate("lampblack", "Pitch Floor");
    case Kind::LightPlace:
        break;
    }
    return QCoreApplication::translate("lampblack", "Move Light");
}

Scene Drag::moved(const Scene& scene, const QPointF& pointer, bool constrain) const
{
    Scene result = scene;
    if (mHandle.part == HandlePart::Floor)
    {
        if (result.floor)
            result.floor = changedAt(mFloor, mFrame, movedFloor(pointer, constrain));
    }
    else if (mHandle.light < result.lights.size())
    {
        result.lights[mHandle.light] = changedAt(mLight, mFrame, movedLight(pointer, constrain));
    }
    return result;
}

Scene Drag::restored(const Scene& scene) const
{
    Scene result = scene;
    if (mHandle.part == HandlePart::Floor)
        result.floor = mFloor;
    else if (mHandle.light < result.lights.size())
        result.lights[mHandle.light] = mLight;
    return result;
}

AreaLight Drag::movedLight(const QPointF& pointer, bool constrain) const
{
    AreaLight light = mShownLight;
    QPointF by = pointer - mPress;
    if (mKind == Kind::LightHeight)
    {
        light.z = heightOfStem(stemOfHeight(mShownLight.z, mUnit) - by.y(), mUnit);
        if (constrain)
            light.z = roundTo(light.z, mUnit / 4);
    }
    else if (mKind == Kind::LightSize)
    {
        const double from = std::max(1.0, QLineF(mCentre, mPress).length());
        light.size = std::max(1.0, mShownLight.size * QLineF(mCentre, pointer).length() / from);
        if (constrain)
            light.size = std::max(10.0, roundTo(light.size, 10));
    }
    else
    {
        if (constrain)
            (std::abs(by.x()) >= std::abs(by.y()) ? by.ry() : by.rx()) = 0;
        const QPointF place = mToCanvas.map(mCentre + by);
        light.x = place.x();
        light.y = place.y();
    }
    return light;
}

Floor Drag::movedFloor(const QPointF& pointer, bool constrain) const
{
    Floor floor = mShownFloor;
    if (mKind == Kind::FloorPitch)
    {
        const double down = mToCanvas.map(pointer).y() - mToCanvas.map(mPress).y();
        const double pixels = down / scaleOf(mToCanvas);
        floor.pitch = std::clamp(mShownFloor.pitch + DegreesPerPixel * pixels, 5.0, 85.0);
        if (constrain)
            floor.pitch = roundTo(floor.pitch, 5);
    }
    else
    {
        floor.y = mToCanvas.map(mCentre + pointer - mPress).y();
        if (constrain)
            floor.y = roundTo(floor.y, 10);
    }
    return floor;
}

Scene turnedByWheel(const Scene& scene, int frame, const Handle& handle, double notches, bool fine)
{
    Scene result = scene;
    const double steps = fine ? notches * Fine : notches;
    if (handle.part == HandlePart::Floor && result.floor)
    {
        Floor floor = floorAt(*result.floor, frame);
        floor.pitch = std::clamp(floor.pitch + DegreesPerNotch * steps, 5.0, 85.0);
        result.floor = changedAt(*result.floor, frame, floor);
    }
    else if (handle.light >= 0 && handle.light < result.lights.size())
    {
        AreaLight light = lightAt(result.lights[handle.light], frame);
        light.z += HeightPerNotch * defaultHeight(scene.canvas) * steps;
        result.lights[handle.light] = changedAt(result.lights[handle.light], frame, light);
    }
    return result;
}

} // namespace lampblack
