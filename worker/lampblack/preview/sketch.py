"""Sketched light: passes of a small picture in closed form, without a renderer.

Lambert's cosine on the predicted normals, the falloff of each light, and shadows by marching over
the height. No light bounces.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..composite.open_light import open_light, towards
from ..composite.resample import Box
from ..prepared import PreparedDrawing
from ..render import LightPasses, Passes
from ..scene import AreaLight, Scene, shining

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
            self._light(light, scene) if shines else LightPasses(_DARK, _DARK)
            for light, shines in zip(scene.lights, shining(scene.lights), strict=True)
        )
        open_sky = _OVERHEAD + (1 - _OVERHEAD) * self.normals[..., 2]
        return Passes(lights, LightPasses(_grey(open_sky), _DARK))

    def _light(self, light: AreaLight, scene: Scene) -> LightPasses:
        """A light of power 1, in white: irradiance over pi."""
        ways = towards(light, scene.canvas, self.places)
        strength = open_light(light, scene.canvas, self.normals, ways)
        distance = np.asarray(np.maximum(np.linalg.norm(ways, axis=2), 1e-3), np.float32)
        spread = np.minimum(light.size / 2 / distance, 1)
        return LightPasses(
            _grey(strength * self._reached(ways / distance[..., None], spread)), _DARK
        )

    def _reached(self, to: Floats, spread: Floats) -> Floats:
        """(h, w) in 0..1: how much of the light is not covered by the height on the way to it,
        given the directions ``to`` it, (h, w, 3), and its radius over its distance."""
        level = np.hypot(to[..., 0], to[..., 1])
        slope = to[..., 2] / np.maximum(level, 1e-3)
        rise, covered = self.places[..., 2], np.zeros(level.shape, np.float32)
        rows, columns = level.shape
        row, column = np.indices(level.shape, np.float32)
        longest = 0.6 * max(rows, columns)
        for step in range(1, _STEPS + 1):
            reach = longest * (step / _STEPS) ** 1.5 + 1.0  # in elements
            at_row = row + reach * to[..., 1] / np.maximum(level, 1e-3)
            at_column = column + reach * to[..., 0] / np.maximum(level, 1e-3)
            here = (at_row >= 0) & (at_row < rows) & (at_column >= 0) & (at_column < columns)
            r = np.clip(at_row, 0, rows - 1).astype(np.intp)
            c = np.clip(at_column, 0, columns - 1).astype(np.intp)
            ray = rise + reach * self.cell * slope
            blur = reach * self.cell * np.maximum(spread, 0.03) + self.cell
            over = np.clip((rise[r, c] - ray - self.cell) / blur, 0, 1)
            covered = np.maximum(covered, np.where(here & self.inside[r, c], over, 0))
        covered[level < 1e-3] = 0
        return np.asarray(1 - ndimage.gaussian_filter(covered, 0.7), np.float32)


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


def _grey(light: Floats) -> Floats:
    return np.repeat(light[..., None], 3, axis=2).astype(np.float32)
