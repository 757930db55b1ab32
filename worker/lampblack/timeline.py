"""The timeline: lights and floor as they are at one frame, between their keys."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from .colour import hex_linear, srgb
from .scene import AreaLight, Floor, FloorKey, LightKey, Scene

Key = TypeVar("Key", LightKey, FloorKey)


def scene_at(scene: Scene, frame: int) -> Scene:
    """``scene`` as it is at ``frame``, without keys; ``scene`` itself if nothing is keyed."""
    if not is_keyed(scene):
        return scene
    floor = scene.floor
    return replace(
        scene,
        lights=tuple(_light_at(light, frame) for light in scene.lights),
        floor=None if floor is None else _floor_at(floor, frame),
    )


def is_keyed(scene: Scene) -> bool:
    """Whether ``scene`` differs from frame to frame."""
    return any(light.keys for light in scene.lights) or bool(scene.floor and scene.floor.keys)


def _light_at(light: AreaLight, frame: int) -> AreaLight:
    if not light.keys:
        return light
    key = _between(light.keys, frame, _mix_lights)
    return replace(
        light, x=key.x, y=key.y, z=key.z, size=key.size, colour=key.colour, power=key.power, keys=()
    )


def _floor_at(floor: Floor, frame: int) -> Floor:
    if not floor.keys:
        return floor
    key = _between(floor.keys, frame, _mix_floors)
    return replace(floor, y=key.y, pitch=key.pitch, keys=())


def _between(keys: Sequence[Key], frame: int, mix: Callable[[Key, Key, float], Key]) -> Key:
    """The key at ``frame``, mixed from those around it; held outside."""
    at = {key.frame: key for key in keys}
    frames = sorted(at)
    after = bisect_right(frames, frame)
    before, after = frames[max(0, after - 1)], frames[min(after, len(frames) - 1)]
    if before == after or frame <= before:
        return at[before]
    return mix(at[before], at[after], (frame - before) / (after - before))


def _mix_lights(a: LightKey, b: LightKey, share: float) -> LightKey:
    return replace(
        a,
        x=_mix(a.x, b.x, share),
        y=_mix(a.y, b.y, share),
        z=_mix(a.z, b.z, share),
        size=_mix(a.size, b.size, share),
        colour=_mix_colours(a.colour, b.colour, share),
        power=_mix(a.power, b.power, share),
    )


def _mix_floors(a: FloorKey, b: FloorKey, share: float) -> FloorKey:
    return replace(a, y=_mix(a.y, b.y, share), pitch=_mix(a.pitch, b.pitch, share))


def _mix(a: float, b: float, share: float) -> float:
    return a + share * (b - a)


def _mix_colours(a: str, b: str, share: float) -> str:
    """In linear light, as light itself mixes."""
    first, second = hex_linear(a), hex_linear(b)
    mixed = srgb(first + np.float32(share) * (second - first))
    return "#" + bytes(np.rint(mixed * 255).astype(np.uint8)).hex()
