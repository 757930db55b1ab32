// The timeline: lights and floor as they are at one frame, between their keys, and changes to them there.
//
// Between two keys every number changes evenly, colours in linear light; before the first key and after the
// last theirs holds (timeline.py). Of keys at one frame the last counts.
#pragma once

#include "scene/scene.h"

namespace lampblack
{

/// Whether it differs from frame to frame.
bool isKeyed(const Scene& scene);

/// As it is at `frame`, without keys.
AreaLight lightAt(const AreaLight& light, int frame);
Floor floorAt(const Floor& floor, int frame);
Scene sceneAt(const Scene& scene, int frame);

/// By frame, one a frame.
QVector<LightKey> inOrder(const QVector<LightKey>& keys);
QVector<FloorKey> inOrder(const QVector<FloorKey>& keys);

/// The frames of its keys, rising, each once.
QVector<int> keyFrames(const AreaLight& light);
QVector<int> keyFrames(const Floor& floor);

/// Changed so that it is like `shown` at `frame`: by a key there if it has keys, else for good. What
/// would need one key more than MaxKeys is left as it was.
AreaLight changedAt(const AreaLight& light, int frame, const AreaLight& shown);
Floor changedAt(const Floor& floor, int frame, const Floor& shown);

/// With a key at `frame` for what it is like there.
AreaLight withKey(const AreaLight& light, int frame);
Floor withKey(const Floor& floor, int frame);

/// Without the key at `frame`. What loses its last key stays as that was.
AreaLight withoutKey(const AreaLight& light, int frame);
Floor withoutKey(const Floor& floor, int frame);

/// Without any key, for good as it is at `frame`.
inline AreaLight withoutKeys(const AreaLight& light, int frame)
{
    return lightAt(light, frame);
}
inline Floor withoutKeys(const Floor& floor, int frame)
{
    return floorAt(floor, frame);
}

} // namespace lampblack
