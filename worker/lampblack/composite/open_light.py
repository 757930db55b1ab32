"""Open light: direct light in closed form, as if nothing were in its way."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled
from ..scene import AreaLight, Canvas

Floats = NDArray[np.float32]


def towards(light: AreaLight, canvas: Canvas, places: Floats) -> Floats:
    """(h, w, 3) from ``places`` to ``light``, in pixels; a sun's has the same length everywhere.

    Args:
        places: (h, w, 3), x right, y down, z to the viewer, in the pixels of ``light``.
    """
    at = np.array([light.x, light.y, light.z], np.float32)
    if light.kind == "lamp":
        ways = np.empty(places.shape, np.float32)
        _lead(places, at, ways)
        return ways
    way = at - np.array([canvas.width / 2, canvas.height / 2, 0], np.float32)
    way = way if np.abs(way).max() > 1e-3 else np.array([0, 0, 1], np.float32)
    return np.ascontiguousarray(np.broadcast_to(way, places.shape))


def open_light(light: AreaLight, canvas: Canvas, normals: Floats, ways: Floats) -> Floats:
    """(h, w) irradiance over pi of ``light`` in white and of power 1, without shadows.

    Args:
        normals: (h, w, 3), x right, y up, z to the viewer.
        ways: (h, w, 3), see ``towards``.
    """
    found = np.empty(normals.shape[:2], np.float32)
    lamp, unit = light.kind == "lamp", np.float32(canvas.default_height)
    _shine(normals, ways, lamp, unit, np.float32(light.size / 2), found)
    return found


@compiled
def _lead(places: Any, at: Any, ways: Any) -> None:
    for row in range(ways.shape[0]):
        for column in range(ways.shape[1]):
            for axis in range(3):
                ways[row, column, axis] = at[axis] - places[row, column, axis]


@compiled
def _shine(normals: Any, ways: Any, lamp: bool, unit: Any, radius: Any, found: Any) -> None:
    none, least = np.float32(0), np.float32(1e-3)
    for row in range(found.shape[0]):
        for column in range(found.shape[1]):
            x, y, z = ways[row, column, 0], ways[row, column, 1], ways[row, column, 2]
            distance = max(np.sqrt(x * x + y * y + z * z), least)
            facing = normals[row, column, 0] * x - normals[row, column, 1] * y
            strength = max((facing + normals[row, column, 2] * z) / distance, none)
            if lamp:
                around = radius * radius
                strength *= (unit * unit + around) / (distance * distance + around)
                strength *= abs(z) / distance
            found[row, column] = strength
