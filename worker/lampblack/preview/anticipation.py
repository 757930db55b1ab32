"""Anticipated light: what a light that moves will show where it is now, before that is traced.

Its direct light is computed in closed form. To it is added what tracing found beside the direct
light at the nearest place where this light was: light that bounces, and what the closed form does
not know of shadows. So the picture follows the hand at once, and tracing, some pictures late, only
corrects it.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..composite.resample import Band, enlarge
from ..prepared import PreparedDrawing
from ..scene import AreaLight, Canvas
from .bounded import MIB, BoundedStore
from .contribution import LightContribution
from .light_store import AccumulatedLight, LightStore
from .refinement import MISSING, MOVING
from .sketch import SketchedSurface, grey

Floats = NDArray[np.float32]

LONGEST = MOVING[-1].longest
"""Elements of anticipated light along its longer side."""
RANGE = 0.7
"""Distance between two places of a light, in default heights, at which what was found at one says
little of the other."""
DIMMEST, MOST_ADDED = np.float32(0.1), np.float32(0.2)
"""What was found beside direct light leaves this share of it, and adds so much at most: a bright
edge that was missed at one place must not shine at another."""


@dataclass(frozen=True, eq=False)
class AnticipatedLight:
    """Light that was not traced, and the key of the traced light that it was corrected by."""

    light: AccumulatedLight
    corrected_by: Hashable


@dataclass
class Anticipation:
    """Anticipates light from the traced light in ``lights``. Only the painter's thread uses it."""

    lights: LightStore
    _surfaces: BoundedStore[Hashable, SketchedSurface] = field(
        default_factory=lambda: BoundedStore(16 * MIB)
    )
    _found_beside: BoundedStore[Hashable, Floats] = field(
        default_factory=lambda: BoundedStore(8 * MIB)
    )

    def of(
        self, contribution: LightContribution, drawing: PreparedDrawing
    ) -> AnticipatedLight | None:
        """The light of ``contribution``; None if it was never traced at another place.

        The floor's shadow and reflections stay where they were traced last.
        """
        near = self.lights.nearest(contribution)
        if near is None or contribution.light is None:
            return None
        there, traced = near
        first = traced.first
        if contribution.subject == "character":
            first = grey(self._direct(contribution, contribution.light, drawing))
            first += self._correction(contribution, there, traced, drawing, first)
        light = AccumulatedLight(MISSING, 0, traced.amounts, first, traced.second)
        return AnticipatedLight(light, (there.key, traced.level))

    def _correction(
        self,
        contribution: LightContribution,
        there: LightContribution,
        traced: AccumulatedLight,
        drawing: PreparedDrawing,
        direct: Floats,
    ) -> Floats:
        key = there.key, traced.level
        found = self._found_beside.get(key)
        if found is None:
            assert there.light is not None
            height, width = direct.shape[:2]
            whole = enlarge(traced.first, Band(width, height, 0, height))
            found = whole - grey(self._direct(there, there.light, drawing))
            self._found_beside.put(key, found, found.nbytes)
        apart = contribution.distance_to(there) / RANGE
        share = np.float32(math.exp(-apart * apart))
        return share * np.clip(found, (DIMMEST - 1) * direct, MOST_ADDED)

    def _direct(
        self, contribution: LightContribution, light: AreaLight, drawing: PreparedDrawing
    ) -> Floats:
        key = drawing.digest, drawing.detail, contribution.area
        surface = self._surfaces.get(key)
        if surface is None:
            _, _, width, height = contribution.area
            scale = LONGEST / max(width, height)
            size = max(1, round(width * scale)), max(1, round(height * scale))
            surface = SketchedSurface.of(drawing, contribution.area, size)
            self._surfaces.put(key, surface, surface.nbytes)
        return surface.light(light, contribution.canvas)


def warm_up() -> None:
    """Load the compiled loops, or compile them."""
    flat = np.zeros((2, 2, 3), np.float32)
    surface = SketchedSurface(
        flat + np.array([0, 0, 1], np.float32), flat, np.ones((2, 2), np.bool_), 1.0
    )
    surface.light(AreaLight(1.0, 1.0, 2.0), Canvas(2, 2))
