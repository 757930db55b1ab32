"""Sketched light: passes of a small picture in closed form, without a renderer.

Lambert's cosine on the predicted normals, the falloff of each light, and shadows by marching over
the height. No light bounces.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..compiled import compiled
from ..composite.open_light import open_light, towards
from ..composite.resample import Box
from ..prepared import PreparedDrawing
from ..render.passes import LightPasses, Passes
from ..scene import AreaLight, Canvas, Scene, shining

Floats = NDArray[np.float32]
Sample = TypeVar("Sample", bound=np.generic)

_STEPS = 20
"""Places between a point and the light at which the height is looked up."""
_OVERHEAD = np.float32(0.75)
"""Share of the ambient light that also reaches a surface seen from the side."""
_DARK = np.zeros((1, 1, 3), np.float32)


@dataclass(frozen=True, eq=False)
class SketchedSurface:
    """A small copy of a drawing's surface, h x w.

    Attributes:
        normals: (h, w, 3), x right, y up, z to the viewer.
        places: (h, w, 3), x right, y down, z to the viewer, in pixels of the drawing.
        inside: (h, w) bool, the character.
        cell: pixels of the drawing from one element to the next.
    """

    normals: Floats
    places: Floats
    inside: NDArray[np.bool_]
    cell: float

    @property
    def nbytes(self) -> int:
        """Memory in bytes."""
        return self.normals.nbytes + self.places.nbytes + self.inside.nbytes

    @staticmethod
    def of(drawing: PreparedDrawing, crop: Box, size: tuple[int, int]) -> SketchedSurface:
        """The part of ``drawing`` in ``crop``, in its pixels, at ``size`` (width, height).

        Args:
            drawing: with normals.
        """
        assert drawing.normals is not None
        x, y, width, height = crop
        across = x + (np.arange(size[0], dtype=np.float32) + 0.5) * (width / size[0])
        down = y + (np.arange(size[1], dtype=np.float32) + 0.5) * (height / size[1])
        mask = _taken(drawing.mask, across, down, drawing.size)
        inside = mask & _within(across, down, drawing.size)
        normals = _taken(drawing.normals.astype(np.float32), across, down, drawing.size)
        normals[~inside] = 0, 0, 1
        rise = np.where(inside, _taken(drawing.height, across, down, drawing.size), 0)
        rise = ndimage.gaussian_filter(rise.astype(np.float32), 0.8)  # single samples are jagged
        places = np.dstack([*np.meshgrid(across, down), rise]).astype(np.float32)
        return SketchedSurface(normals, places, inside, width / size[0])

    def passes(self, scene: Scene) -> Passes:
        """The light of ``scene``, in pixels of the drawing, on the character."""
        lights = tuple(
            LightPasses(grey(self.light(light, scene.canvas)) if shines else _DARK, _DARK)
            for light, shines in zip(scene.lights, shining(scene.lights), strict=True)
        )
        open_sky = _OVERHEAD + (1 - _OVERHEAD) * self.normals[..., 2]
        return Passes(lights, LightPasses(grey(open_sky), _DARK))

    def light(self, light: AreaLight, canvas: Canvas) -> Floats:
        """(h, w) irradiance over pi of ``light`` in white and of power 1, which does not bounce."""
        ways = towards(light, canvas, self.places)
        strength = open_light(light, canvas, self.normals, ways)
        if not light.casts_shadow:
            return strength
        covered = np.empty(strength.shape, np.float32)
        _cover(
            self.places[..., 2].copy(), self.inside, ways,
            np.float32(light.size / 2), np.float32(self.cell), covered,
        )  # fmt: skip
        reached = 1 - ndimage.gaussian_filter(covered, 0.7)
        return np.asarray(strength * reached, np.float32)


@compiled
def _cover(rise: Any, inside: Any, ways: Any, radius: Any, cell: Any, covered: Any) -> None:
    """Write to ``covered``, (h, w) in 0..1, how much of a light of this ``radius`` the height
    ``rise`` hides on the way to it, ``ways``; lengths in pixels of the drawing."""
    rows, columns = covered.shape
    none, one, least = np.float32(0), np.float32(1), np.float32(1e-3)
    longest = np.float32(0.6 * max(rows, columns))
    reaches = np.empty(_STEPS, np.float32)  # in elements
    for step in range(_STEPS):
        reaches[step] = longest * ((step + 1) / _STEPS) ** 1.5 + 1.0
    for row in range(rows):
        for column in range(columns):
            covered[row, column] = none
            x, y, z = ways[row, column, 0], ways[row, column, 1], ways[row, column, 2]
            distance = max(np.sqrt(x * x + y * y + z * z), least)
            level = np.sqrt(x * x + y * y) / distance
            if level < least:
                continue
            across, down = x / distance / level, y / distance / level
            slope, spread = z / distance / level, max(min(radius / distance, one), np.float32(0.03))
            hidden = none
            for step in range(_STEPS):
                reach = reaches[step]
                r, c = row + reach * down, column + reach * across
                if r < 0 or r >= rows or c < 0 or c >= columns:
                    break
                r, c = int(min(r, rows - 1)), int(min(c, columns - 1))
                if inside[r, c]:
                    ray = rise[row, column] + reach * cell * slope
                    blur = reach * cell * spread + cell
                    hidden = max(hidden, (rise[r, c] - ray - cell) / blur)
            covered[row, column] = min(hidden, one)


def normals_picture(drawing: PreparedDrawing, side: int) -> NDArray[np.uint8]:
    """(h, w, 4) uint8, its longer side ``side``: (n + 1) / 2 over the whole drawing, opaque in the
    character and black elsewhere."""
    scale = side / max(drawing.size)
    size = max(1, round(drawing.size[0] * scale)), max(1, round(drawing.size[1] * scale))
    surface = SketchedSurface.of(drawing, (0, 0, *drawing.size), size)
    inside = surface.inside[..., None]
    colour = np.rint((surface.normals + 1) * 127.5) * inside
    return np.asarray(np.concatenate([colour, inside * 255.0], axis=2), np.uint8)


def _taken(
    plane: NDArray[Sample], across: Floats, down: Floats, size: tuple[int, int]
) -> NDArray[Sample]:
    """The elements of ``plane``, which covers a drawing of ``size``, at these pixels of it."""
    rows, columns = plane.shape[:2]
    row = np.clip(down * rows / size[1], 0, rows - 1).astype(np.intp)
    column = np.clip(across * columns / size[0], 0, columns - 1).astype(np.intp)
    taken: NDArray[Sample] = plane[np.ix_(row, column)]
    return taken


def _within(across: Floats, down: Floats, size: tuple[int, int]) -> NDArray[np.bool_]:
    inside = (down >= 0) & (down < size[1])
    return np.asarray(inside[:, None] & ((across >= 0) & (across < size[0]))[None])


def grey(light: Floats) -> Floats:
    """(h, w, 3) of (h, w): the same light in all channels."""
    return np.repeat(light[..., None], 3, axis=2).astype(np.float32)
