#include "scene/rig_place.h"

#include "scene/style_place.h"

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{

constexpr double Farthest = 1e5;
constexpr double Strongest = 100;
constexpr int MaxName = 80;

double within(double place)
{
    return std::clamp(place, -Farthest, Farthest);
}

/// From one canvas to a box on another: the middle on the middle, the longer side on the longer side.
class Place
{
public:
    Place(const Canvas& from, const Canvas& to, const QRectF& box)
        : mFrom(from), mTo(to), mMiddle(box.center()),
          mScale(std::max(box.width(), box.height()) / 2 / defaultHeight(from))
    {
    }

    double scale() const { return mScale; }

    template <class Light> void move(Light& light, bool isSun) const
    {
        // A sun shines towards the middle of the canvas, wherever the box is.
        const QPointF middle = isSun ? QPointF(mTo.width / 2.0, mTo.height / 2.0) : mMiddle;
        if (!isSun)
            light.power = std::min(Strongest, light.power * dimming(light.size));
        light.x = within(middle.x() + mScale * (light.x - mFrom.width / 2.0));
        light.y = within(middle.y() + mScale * (light.y - mFrom.height / 2.0));
        light.z = within(mScale * light.z);
        light.size = std::clamp(mScale * light.size, 1.0, Farthest);
    }

private:
    /// A lamp of power 1 has an irradiance of (1 + r^2) / (d^2 + r^2) at a distance of d, in units of the
    /// canvas's default height, where r is its radius.
    double dimming(double size) const
    {
        const double radius = size / 2 / defaultHeight(mFrom);
        const double nearer = mScale * defaultHeight(mFrom) / defaultHeight(mTo);
        return nearer * nearer * (1 + radius * radius) / (1 + radius * nearer * radius * nearer);
    }

    Canvas mFrom;
    Canvas mTo;
    QPointF mMiddle;
    double mScale;
};

} // namespace

Rig rigOf(const Scene& scene, const QString& name)
{
    Rig rig;
    rig.canvas = scene.canvas;
    rig.name = name.left(MaxName);
    rig.lights = scene.lights;
    rig.ambient = scene.ambient;
    return rig;
}

Scene withRig(Scene scene, const Rig& rig, const QRectF& box)
{
    const QRectF whole(QPointF(), sizeOf(scene.canvas));
    const Place place(rig.canvas, scene.canvas, box.isEmpty() ? whole : box);
    scene.lights = rig.lights;
    scene.ambient = rig.ambient;
    for (AreaLight& light : scene.lights)
    {
        const bool isSun = light.kind == LightKind::Sun;
        place.move(light, isSun);
        for (LightKey& key : light.keys)
            place.move(key, isSun);
    }
    if (rig.look || rig.rim)
    {
        scene.look = rig.look.value_or(scene.look);
        scene.rim = scaledRim(rig.rim, place.scale());
    }
    return scene;
}

} // namespace lampblack
