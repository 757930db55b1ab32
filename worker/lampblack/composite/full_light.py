"""Full light: that on a surface that faces the strongest light. Tones are shares of it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..colour import hex_linear
from ..compiled import compiled
from ..scene import AreaLight, Scene, shining
from .linking import Link
from .resample import Box

BEHIND = 0.25
"""Share of the full light of a light behind the paper."""

Floats = NDArray[np.float32]


def full_light(scene: Scene, link: Link | None = None) -> float:
    """The light on a surface in the middle of the canvas that faces the strongest of the lights
    that light what ``link`` says; None is everything."""
    return max((strength for _, (strength, _) in by_light(scene, link)), default=0.0)


def strongest_light(scene: Scene) -> tuple[float, float]:
    """(x, y) of the light that is strongest in the middle of the canvas; of none, that above the
    upper left."""
    found = [(strength, light.x, light.y) for light, (strength, _) in by_light(scene)]
    _, x, y = max(found, default=(0.0, 0.0, 0.0))
    return x, y


def exposure(light: float) -> float:
    """The factor by which tones are shown: full light up to 1 is shown as it is, more light
    brightens the drawn colours slowly."""
    return 1.0 if light <= 1 else (1 + 0.35 * math.log(light)) / light


def by_light(
    scene: Scene, link: Link | None = None
) -> list[tuple[AreaLight, tuple[float, Floats]]]:
    """Each light that lights what ``link`` says, None is everything; with the light on a surface in
    the middle of the canvas that faces it, and with its colour times its power."""
    middle = scene.canvas.width / 2, scene.canvas.height / 2
    found = []
    for light, shines in zip(scene.lights, shining(scene.lights), strict=True):
        if not shines or Link.of(light) != link:
            continue
        weight = hex_linear(light.colour) * np.float32(light.power)
        distance = math.dist((light.x, light.y, light.z), (*middle, 0)) or 1.0
        near = 1.0 if light.kind == "sun" else (scene.canvas.default_height / distance) ** 2
        behind = min(1.0, max(0.0, -light.z / distance / 0.3))
        strength = float(weight.max()) * near * (1 - (1 - BEHIND) * behind)
        found.append((light, (strength, weight)))
    return found


def reach_of_light(
    scene: Scene, area: Box, size: tuple[int, int], link: Link | None = None
) -> Floats:
    """(h, w) the full light at each element of ``area``: half way between that in the middle of the
    canvas and that at its own distance. A lamp lights what is near it, but tones follow the form
    more than the distance."""
    found = np.full(size, 1e-6, np.float32)
    middle = scene.canvas.width / 2, scene.canvas.height / 2
    height, width = size
    for light, (strength, _) in by_light(scene, link):
        if light.kind == "sun":
            np.maximum(found, np.float32(strength), out=found)
            continue
        far = (middle[0] - light.x) ** 2 + (middle[1] - light.y) ** 2 + light.z**2
        _reach(
            np.float32(area[0] - light.x), np.float32(area[2] / width),
            np.float32(area[1] - light.y), np.float32(area[3] / height),
            np.float32(light.z**2), np.float32(far), np.float32(strength), found,
        )  # fmt: skip
    return found


@compiled
def _reach(
    left: Any, across: Any, top: Any, down: Any, above: Any, far: Any, strength: Any, found: Any
) -> None:
    """Raise ``found`` to the reach of a lamp. ``left`` and ``top`` lead from it to the corner."""
    half, least = np.float32(0.5), np.float32(0.02) * far + np.float32(1)
    for row in range(found.shape[0]):
        y = top + (row + half) * down
        high = y * y + above
        for column in range(found.shape[1]):
            x = left + (column + half) * across
            near = x * x + high
            fall = strength * np.sqrt(far / (near if near > least else least))
            found[row, column] = fall if fall > found[row, column] else found[row, column]


def hue_of_lights(scene: Scene, link: Link | None = None) -> Floats:
    """(3,) the colour of all lights, its brightest channel 1."""
    total = sum((weight for _, (_, weight) in by_light(scene, link)), np.zeros(3, np.float32))
    return np.asarray(total / total.max() if total.max() > 0 else total + 1, np.float32)
