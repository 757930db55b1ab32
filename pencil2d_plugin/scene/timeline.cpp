#include "scene/timeline.h"

#include "scene/generated/scene_keys.h"

#include <algorithm>
#include <cmath>

namespace lampblack
{
namespace
{

double mix(double a, double b, double share)
{
    return a + share * (b - a);
}

/// IEC 61966-2-1, in single precision as colour.py.
float linear(int channel)
{
    const auto s = static_cast<float>(channel / 255.0);
    return s <= 0.04045F ? s / 12.92F : std::pow((s + 0.055F) / 1.055F, 2.4F);
}

int channelOf(float light)
{
    const float s = light <= 0.0031308F ? light * 12.92F : 1.055F * std::pow(light, float(1 / 2.4)) - 0.055F;
    return static_cast<int>(std::nearbyint(s * 255));
}

int mixChannels(int a, int b, double share)
{
    const float first = linear(a);
    return channelOf(first + static_cast<float>(share) * (linear(b) - first));
}

QColor mix(const QColor& a, const QColor& b, double share)
{
    return {mixChannels(a.red(), b.red(), share), mixChannels(a.green(), b.green(), share),
            mixChannels(a.blue(), b.blue(), share)};
}

/// Whole numbers, words, yes and no hold until the next key.
template <class Value> Value mix(const Value& a, const Value& /*b*/, double /*share*/)
{
    return a;
}

/// Hundredths are finer than anyone sees, and let a scene full of keys fit into one message.
void shorten(double& value)
{
    value = std::round(value * 100) / 100;
}

template <class Value> void shorten(Value& /*value*/)
{
}

/// What a light or floor has of a key, or a key of these.
template <class Thing, class From, class To> void copy(const From& from, To& to)
{
    Keyed<Thing>::each([](const auto& value, auto& place) { place = value; }, from, to);
}

template <class Key> QVector<Key> ordered(QVector<Key> keys)
{
    std::stable_sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.frame < b.frame; });
    QVector<Key> distinct;
    for (const Key& key : qAsConst(keys))
    {
        if (!distinct.isEmpty() && distinct.last().frame == key.frame)
            distinct.last() = key;
        else
            distinct << key;
    }
    return distinct;
}

template <class Thing> Thing thingAt(const Thing& thing, int frame)
{
    if (thing.keys.isEmpty())
        return thing;
    const auto keys = ordered(thing.keys);
    const auto after =
        std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return key.frame > frame; });
    Thing still = thing;
    still.keys.clear();
    if (after == keys.begin())
        copy<Thing>(keys.first(), still);
    else if (after == keys.end())
        copy<Thing>(keys.last(), still);
    else
    {
        const auto before = std::prev(after);
        const double share = double(frame - before->frame) / (after->frame - before->frame);
        Keyed<Thing>::each([share](const auto& a, const auto& b, auto& place) { place = mix(a, b, share); },
                           *before, *after, still);
    }
    return still;
}

template <class Thing> QVector<int> framesOf(const Thing& thing)
{
    QVector<int> frames;
    for (const auto& key : ordered(thing.keys))
        frames << key.frame;
    return frames;
}

template <class Thing> Thing keyed(const Thing& thing, int frame, const Thing& shown)
{
    Thing result = thing;
    result.keys = ordered(thing.keys);
    auto& keys = result.keys;
    auto at = std::find_if(keys.begin(), keys.end(), [&](const auto& key) { return key.frame >= frame; });
    if (at == keys.end() || at->frame != frame)
    {
        if (keys.size() >= MaxKeys)
            return thing;
        at = keys.insert(at, {});
        at->frame = frame;
    }
    copy<Thing>(shown, *at);
    Keyed<Thing>::each([](auto& value) { shorten(value); }, *at);
    return result;
}

template <class Thing> Thing changed(const Thing& thing, int frame, const Thing& shown)
{
    if (shown == thingAt(thing, frame))
        return thing;
    return thing.keys.isEmpty() ? shown : keyed(thing, frame, shown);
}

template <class Thing> Thing unkeyed(const Thing& thing, int frame)
{
    Thing result = thing;
    auto& keys = result.keys;
    keys.erase(std::remove_if(keys.begin(), keys.end(), [&](const auto& key) { return key.frame == frame; }),
               keys.end());
    return keys.isEmpty() ? thingAt(thing, frame) : result;
}

} // namespace

bool isKeyed(const Scene& scene)
{
    return (scene.floor && !scene.floor->keys.isEmpty()) ||
           std::any_of(scene.lights.begin(), scene.lights.end(),
                       [](const AreaLight& light) { return !light.keys.isEmpty(); });
}

AreaLight lightAt(const AreaLight& light, int frame)
{
    return thingAt(light, frame);
}

Floor floorAt(const Floor& floor, int frame)
{
    return thingAt(floor, frame);
}

Scene sceneAt(const Scene& scene, int frame)
{
    Scene still = scene;
    for (AreaLight& light : still.lights)
        light = lightAt(light, frame);
    if (still.floor)
        still.floor = floorAt(*still.floor, frame);
    return still;
}

QVector<LightKey> inOrder(const QVector<LightKey>& keys)
{
    return ordered(keys);
}

QVector<FloorKey> inOrder(const QVector<FloorKey>& keys)
{
    return ordered(keys);
}

QVector<int> keyFrames(const AreaLight& light)
{
    return framesOf(light);
}

QVector<int> keyFrames(const Floor& floor)
{
    return framesOf(floor);
}

AreaLight changedAt(const AreaLight& light, int frame, const AreaLight& shown)
{
    return changed(light, frame, shown);
}

Floor changedAt(const Floor& floor, int frame, const Floor& shown)
{
    return changed(floor, frame, shown);
}

AreaLight withKey(const AreaLight& light, int frame)
{
    return keyed(light, frame, lightAt(light, frame));
}

Floor withKey(const Floor& floor, int frame)
{
    return keyed(floor, frame, floorAt(floor, frame));
}

AreaLight withoutKey(const AreaLight& light, int frame)
{
    return unkeyed(light, frame);
}

Floor withoutKey(const Floor& floor, int frame)
{
    return unkeyed(floor, frame);
}

} // namespace lampblack
