"""The timeline: lights and floor at one frame, interpolated between their keys."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar, get_type_hints

import numpy as np

from .colour import hex_linear, srgb
from .scene import AreaLight, Colour, Floor, FloorKey, LightKey, Scene

Keyed = TypeVar("Keyed", AreaLight, Floor)
Key = TypeVar("Key", LightKey, FloorKey)
Mix = Callable[[Any, Any, float], Any]


def scene_at(scene: Scene, frame: int) -> Scene:
    """``scene`` at ``frame``, without keys; ``scene`` itself if nothing is keyed."""
    if not is_keyed(scene):
        return scene
    floor = scene.floor
    return replace(
        scene,
        lights=tuple(_still(light, frame) for light in scene.lights),
        floor=None if floor is None else _still(floor, frame),
    )


def is_keyed(scene: Scene) -> bool:
    """Whether ``scene`` differs from frame to frame."""
    return any(light.keys for light in scene.lights) or bool(scene.floor and scene.floor.keys)


def _still(thing: Keyed, frame: int) -> Keyed:
    if not thing.keys:
        return thing
    key = _key_at(thing.keys, frame)
    return replace(thing, keys=(), **{name: getattr(key, name) for name in KEYED_FIELDS[type(key)]})


def _key_at(keys: Sequence[Key], frame: int) -> Key:
    """The key at ``frame``, mixed from those around it; held outside."""
    at = {key.frame: key for key in keys}
    frames = sorted(at)
    after = bisect_right(frames, frame)
    before, after = frames[max(0, after - 1)], frames[min(after, len(frames) - 1)]
    if before == after or frame <= before:
        return at[before]
    a, b, share = at[before], at[after], (frame - before) / (after - before)
    fields = KEYED_FIELDS[type(a)].items()
    mixed = {name: mix(getattr(a, name), getattr(b, name), share) for name, mix in fields}
    return replace(a, **mixed)


def _mix_for(hint: Any) -> Mix:
    if hint == Colour:
        return _mix_colours
    return _mix_numbers if getattr(hint, "__origin__", hint) is float else _hold


def _mix_numbers(a: float, b: float, share: float) -> float:
    return a + share * (b - a)


def _mix_colours(a: str, b: str, share: float) -> str:
    """Interpolate ``#rrggbb`` colours in linear light."""
    first, second = hex_linear(a), hex_linear(b)
    mixed = srgb(first + np.float32(share) * (second - first))
    return "#" + bytes(np.rint(mixed * 255).astype(np.uint8)).hex()


def _hold(a: object, _b: object, _share: float) -> object:
    """Whole numbers, words, yes and no stay as they were until the next key."""
    return a


KEYED_FIELDS: Mapping[type, Mapping[str, Mix]] = {
    key: {
        name: _mix_for(hint)
        for name, hint in get_type_hints(key, include_extras=True).items()
        if name not in ("frame", "extra")
    }
    for key in (LightKey, FloorKey)
}
"""The fields that a key gives to its light or floor, and how each changes to the next key."""
