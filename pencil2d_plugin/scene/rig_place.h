// Rigs on canvases: the lights of a scene, to be used again in others.
#pragma once

#include "scene/scene.h"

#include <QRectF>

namespace lampblack
{

/// The light of `scene`, on its own canvas.
Rig rigOf(const Scene& scene, const QString& name);

/// `scene` in the light of `rig`, which replaces its own, as `with_rig` in Python places it. `box` is where
/// the rig's canvas comes to lie, in canvas pixels; empty: all of the canvas.
Scene withRig(Scene scene, const Rig& rig, const QRectF& box = {});

} // namespace lampblack
