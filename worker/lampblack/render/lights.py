"""The lights of the Blender scene: lamps, suns, and the world as ambient light."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..choices import LightKind
from ..colour import hex_linear
from ..scene import Ambient, AreaLight, Canvas

AMBIENT_SHEEN = 0.2  # full reflections of a white surrounding would whiten every glossy colour

Floats = NDArray[np.float32]


class Lights:
    """Blender's lights, kept between renders: those that do not shine are hidden."""

    def __init__(self, scene: Any) -> None:
        self._scene = scene
        self._lamps: dict[LightKind, list[Any]] = {"lamp": [], "sun": []}
        scene.world = bpy.data.worlds.new("ambient")
        # Sampled by bounces only: shadow rays would pass through the floor.
        scene.world.cycles.sampling_method = "NONE"
        self._ambient = _ambient_light(scene.world.node_tree)

    def shine(self, lights: Sequence[AreaLight], ambient: Ambient, canvas: Canvas) -> list[Any]:
        """Turn on ``lights`` and ``ambient`` in their colours and powers, and nothing else. Returns
        Blender's objects of the lights."""
        colour, strength = self._ambient
        colour.default_value = hex_linear(ambient.colour).tolist()
        strength.default_value = ambient.strength
        for lamp in (*self._lamps["lamp"], *self._lamps["sun"]):
            lamp.hide_render = True
        free = {kind: list(made) for kind, made in self._lamps.items()}
        shining = []
        for light in lights:
            lamp = free[light.kind].pop(0) if free[light.kind] else self._add(light.kind)
            lamp.hide_render = False
            _set_light(lamp, light, canvas)
            shining.append(lamp)
        return shining

    def _add(self, kind: LightKind) -> Any:
        data = bpy.data.lights.new(kind, "SUN" if kind == "sun" else "AREA")
        lamp = bpy.data.objects.new(kind, data)
        self._scene.collection.objects.link(lamp)
        if kind == "lamp":
            data.shape = "DISK"
            data.normalize = False
            lamp.visible_camera = False
        self._lamps[kind].append(lamp)
        return lamp


def to_blender(points: Floats, canvas: Canvas) -> Floats:
    """(N, 3) canvas pixels to Blender's frame."""
    centre = np.array([canvas.width / 2, canvas.height / 2, 0], np.float32)
    flip = np.array([1, -1, 1], np.float32)
    return ((points - centre) * flip / np.float32(canvas.default_height)).astype(np.float32)


def _ambient_light(tree: Any) -> tuple[Any, Any]:
    """Dim the world to ``AMBIENT_SHEEN`` for glossy rays. Returns the sockets of its colour and
    strength."""
    background = tree.nodes["Background"].inputs
    path, share = tree.nodes.new("ShaderNodeLightPath"), tree.nodes.new("ShaderNodeMath")
    share.operation = "MULTIPLY_ADD"
    tree.links.new(path.outputs["Is Glossy Ray"], share.inputs[0])
    share.inputs[1].default_value = AMBIENT_SHEEN - 1
    share.inputs[2].default_value = 1
    tint = tree.nodes.new("ShaderNodeVectorMath")
    tint.operation = "SCALE"
    tree.links.new(share.outputs[0], tint.inputs["Scale"])
    tree.links.new(tint.outputs[0], background["Color"])
    return tint.inputs[0], background["Strength"]


def _set_light(lamp: Any, light: AreaLight, canvas: Canvas) -> None:
    lamp.data.color = hex_linear(light.colour).tolist()
    at = to_blender(np.array([[light.x, light.y, light.z]], np.float32), canvas)[0]
    radius = light.size / 2 / canvas.default_height
    if light.kind == "sun":
        lamp.data.energy = math.pi * light.power  # an irradiance of pi on a facing surface
        _set_sun(lamp, at, radius)
        return
    lamp.location = at
    lamp.rotation_euler = (math.pi if light.z < 0 else 0, 0, 0)
    lamp.data.size = 2 * radius
    # Radiance that lights a facing surface at distance 1 to an irradiance of pi.
    lamp.data.energy = math.pi * (radius**2 + 1) / radius**2 * light.power


def _set_sun(sun: Any, at: Floats, radius: float) -> None:
    """Let ``sun`` shine from the disk at ``at`` towards the origin; from the front, if it is there.
    Cycles lights a facing surface alike for all angles up to half of the sky."""
    distance = float(np.linalg.norm(at))
    x, y, z = (0.0, 0.0, 1.0) if distance < 1e-6 else (at / distance).tolist()
    sun.rotation_euler = (-math.asin(min(1.0, max(-1.0, y))), math.atan2(x, z), 0)
    sun.data.angle = 2 * math.atan2(radius, distance)
