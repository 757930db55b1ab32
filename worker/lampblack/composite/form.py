"""Form: a small copy of the surface, by which the composite tells shadows from surfaces that turn
away from the light."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..colour import hex_linear
from ..drawing.morphology import from_nearest
from ..scene import Scene, shining
from .linking import Link
from .open_light import open_light, towards
from .resample import Box

LONGEST = 256
"""Elements along the longer side of a form, at most."""
SAMPLED = 128
"""The same of what is computed from it."""
STEEPEST = 4.0
"""Greatest slope that counts: steps of the height between parts are no surface."""

Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Form:
    """A small copy of a surface, h x w.

    Attributes:
        slopes: (h, w, 2), how steeply the height rises to the right and down.
        rise: (h, w) the height in pixels of the drawing.
        inside: (h, w) in 0..1, how much of each element is in the character.
        size: (width, height) of the area that it covers, in pixels of the drawing.
    """

    slopes: Floats
    rise: Floats
    inside: Floats
    size: tuple[float, float]

    @staticmethod
    def of(height: Floats, mask: NDArray[np.bool_], scale: float) -> Form:
        """The form of a height.

        Args:
            height: (H, W) in pixels of the drawing. mask: (H, W), the character.
            scale: pixels of the drawing from one element to the next.
        """
        step = -(-max(height.shape) // LONGEST)
        rise = height.astype(np.float32, copy=False)
        planes = [_filled(rise, mask, step)]
        for axis in (1, 0):
            near, far = [slice(None)] * 2, [slice(None)] * 2
            near[axis], far[axis] = slice(None, -1), slice(1, None)
            one, other = tuple(near), tuple(far)
            slope, both = np.zeros_like(rise), np.zeros_like(mask)
            slope[one] = (rise[other] - rise[one]) / np.float32(scale)
            both[one] = mask[one] & mask[other]
            planes.append(_filled(np.clip(slope, -STEEPEST, STEEPEST), both, step))
        inside = _means(mask.astype(np.float32), step)
        rows, columns = (float(side * step * scale) for side in inside.shape)
        return Form(np.dstack(planes[1:]), planes[0], inside, (columns, rows))

    def within(self, area: Box) -> Form:
        """The part of the surface in ``area``, in pixels of the drawing, in few elements. Its size
        is that of the area."""
        return _part(self, area)

    def _sampled(self, area: Box) -> Form:
        x, y, width, height = area
        across, down = self.size[0] / self.rise.shape[1], self.size[1] / self.rise.shape[0]
        step = max(across, down, max(width, height) / SAMPLED)
        columns, rows = max(1, round(width / step)), max(1, round(height / step))
        at = np.meshgrid(
            (y + (np.arange(rows) + 0.5) * height / rows) / down - 0.5,
            (x + (np.arange(columns) + 0.5) * width / columns) / across - 0.5,
            indexing="ij",
        )

        def taken(plane: Floats) -> Floats:
            found: Floats = ndimage.map_coordinates(plane, at, order=1, mode="nearest")
            return found

        slopes = np.dstack([taken(self.slopes[..., axis]) for axis in (0, 1)])
        return Form(slopes, taken(self.rise), taken(self.inside), (width, height))

    def open_light(self, scene: Scene, corner: tuple[float, float], link: Link | None) -> Floats:
        """(h, w) the brightest channel of the direct light of all lights that light what ``link``
        says, without shadows; in the measure of ``LightPasses``.

        Args:
            corner: x and y of the form in pixels of ``scene``.
        """
        places, normals = _laid_out(self, corner, scene.relief_scale)
        total = np.zeros((3, *self.rise.shape), np.float32)
        for light, shines in zip(scene.lights, shining(scene.lights), strict=True):
            if shines and Link.of(light) == link:
                weight = hex_linear(light.colour) * np.float32(light.power)
                ways = towards(light, scene.canvas, places)
                total += weight[:, None, None] * open_light(light, scene.canvas, normals, ways)
        return np.asarray(total.max(axis=0), np.float32)


# While colours and powers change, or a light is dragged, these stay.
@lru_cache(maxsize=8)
def _part(form: Form, area: Box) -> Form:
    return form._sampled(area)


@lru_cache(maxsize=8)
def _laid_out(
    form: Form, corner: tuple[float, float], relief_scale: float
) -> tuple[Floats, Floats]:
    """(h, w, 3) each, where the elements of ``form`` are and which way they face, as
    ``towards`` and ``open_light`` take them."""
    rows, columns = form.rise.shape
    x = corner[0] + (np.arange(columns, dtype=np.float32) + 0.5) * (form.size[0] / columns)
    y = corner[1] + (np.arange(rows, dtype=np.float32) + 0.5) * (form.size[1] / rows)
    relief = np.float32(relief_scale)
    places = np.dstack([*np.meshgrid(x, y), relief * form.rise]).astype(np.float32)
    normals = np.dstack(
        [-relief * form.slopes[..., 0], relief * form.slopes[..., 1], np.ones_like(form.rise)]
    ).astype(np.float32)
    normals /= np.sqrt(np.square(normals).sum(axis=2, keepdims=True))
    return places, normals


def _filled(plane: Floats, known: NDArray[np.bool_], step: int) -> Floats:
    """The means of what is known in squares of ``step`` elements. The surface goes on past the
    outline, so that the light there is that beside it."""
    weight = _means(known.astype(np.float32), step)
    sums = _means(np.where(known, plane, np.float32(0)), step)
    found = np.divide(sums, np.maximum(weight, 1e-6), dtype=np.float32)
    return from_nearest(found, weight > 0) if weight.any() else found


def _means(plane: Floats, step: int) -> Floats:
    """The means of squares of ``step`` elements."""
    rows, columns = (-(-side // step) for side in plane.shape)
    padded = np.pad(
        plane, ((0, rows * step - plane.shape[0]), (0, columns * step - plane.shape[1]))
    )
    return np.asarray(padded.reshape(rows, step, columns, step).mean(axis=(1, 3)), np.float32)
