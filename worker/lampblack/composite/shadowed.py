"""Direct light told from light that is reflected into the shade, and cast shadows from surfaces
that turn away from the light.

Both compare the traced light with open light, that without shadows.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled
from ..scene import Scene
from .blur import blurred
from .form import Form
from .resample import Box
from .samples import resized

AWAY = 0.12
"""Open light below which a surface counts as turned away, as a share of the full light."""
AROUND = 0.08
"""Deviation of the smoothing of reflected light, as a share of the longer side."""
BLOCKED = 0.7
"""Share of the open light below which a surface is in a cast shadow."""

Floats = NDArray[np.float32]


def reflected_into_shade(light: Floats, form: Form, scene: Scene, area: Box, full: float) -> Floats:
    """(h, w) the light on surfaces that turn away from all lights, continued over the others. It
    is reflected by the floor and by other parts. Tones follow direct light: reflected light brings
    the shade so close to a step that noise crosses it.

    Args:
        light: (h, w) as it is traced, in ``area``. full: the full light.
    """
    there = form.within(area)
    unblocked = there.open_light(scene, (area[0], area[1]), None)
    away = there.inside * np.clip(1 - unblocked / np.float32(AWAY * full), 0, 1)
    deviation = AROUND * max(unblocked.shape)
    weight = blurred(away, deviation) + np.float32(1e-3)
    return resized(blurred(away * resized(light, away.shape), deviation) / weight, light.shape)


def cast_shadow(
    amount: Floats, reach: Any, form: Form, scene: Scene, area: Box, step: float
) -> Floats:
    """(h, w) where something is in the way of the light: more than 0.5 there, less elsewhere.

    Args:
        amount: (h, w) direct light in ``area``, as a share of ``reach``, (h, w) the full light.
        step: the amount below which there is shade. A surface that would be in shade without
            shadows turns away.
    """
    unblocked = form.within(area).open_light(scene, (area[0], area[1]), None)
    found = np.empty(amount.shape, np.float32)
    _cast(resized(unblocked, amount.shape), reach, amount, np.float32(max(step, 1e-3)), found)
    return found


@compiled
def _cast(unblocked: Any, reach: Any, amount: Any, step: Any, found: Any) -> None:
    half, one, least = np.float32(0.5), np.float32(1), np.float32(0.02)
    for row in range(found.shape[0]):
        for column in range(found.shape[1]):
            would = unblocked[row, column] / reach[row, column]
            blocked = np.float32(BLOCKED) - amount[row, column] / max(would, least)
            facing = half * (would / step - one)
            found[row, column] = min(max(half + min(blocked, facing), np.float32(0)), one)
