"""Prepared drawings: layers, height and surface, ready to be lit."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from .composite.byte_layers import ByteLayers, byte_layers_of
from .composite.resample import Box
from .drawing import Drawing
from .render import Surface, assign_materials, vertex_pixels
from .scene import Scene
from .surface import Relief, build_relief
from .surface.overlap import Overlap

Detail = Literal["quick", "full"]

Sample = TypeVar("Sample", bound=np.generic)


@dataclass(frozen=True, eq=False)
class PreparedDrawing:
    """A drawing that is ready to be lit, for finals and for previews.

    Attributes:
        digest: identifies the drawing; empty where drawings are not identified by content.
        detail: ``full`` for finals; ``quick`` is small and has quick normals.
        size: (width, height) of the drawing in pixels.
        layers: the drawing's layers; one of their pixels is ``step`` pixels of the drawing.
        height: (h, w) float32, in pixels of the drawing towards the viewer; one element is
            ``scale`` pixels of the drawing wide.
        mask: (h, w) bool, the character.
        normals: x right, y up, z to the viewer, 0 outside the mask; float32 at the size of
            ``layers`` or ``mask``, or (h, w, 3) float16 when compact. None if not requested.
        box: box around the character, in pixels of the drawing.
        overlaps: where the height steps because one part is in front of another, longest first.
    """

    digest: str
    detail: Detail
    size: tuple[int, int]
    step: int
    layers: Drawing | ByteLayers
    scale: float
    height: NDArray[np.float32]
    mask: NDArray[np.bool_]
    normals: NDArray[np.float32] | NDArray[np.float16] | None
    box: Box
    overlaps: tuple[Overlap, ...] = ()

    @property
    def nbytes(self) -> int:
        """Memory in bytes."""
        normals = 0 if self.normals is None else self.normals.nbytes
        return self.layers.nbytes + self.height.nbytes + self.mask.nbytes + normals

    def compact(self) -> PreparedDrawing:
        """The same drawing in a third of the memory: byte layers, and normals as float16."""
        if isinstance(self.layers, ByteLayers):
            return self
        normals = None
        if self.normals is not None:
            step = max(1, round(self.scale / self.step))
            rows, columns = self.mask.shape
            normals = block_middles(self.normals, step)[:rows, :columns].astype(np.float16)
        return replace(self, layers=byte_layers_of(self.layers), normals=normals)

    def relief(self, *, stride: int = 1, relief_scale: float = 1.0) -> Relief:
        """The character's closed mesh in pixels of the drawing, one vertex every ``stride``
        pixels of the height."""
        scale = np.float32(self.scale)
        relief = build_relief(
            self.height / scale, self.mask, stride=stride, relief_scale=relief_scale
        )
        return replace(relief, vertices=relief.vertices * scale)

    def surface(self, scene: Scene, stride: int) -> Surface:
        """The surface to light: with the relief scale and the materials of ``scene``."""
        return self.with_materials(
            self.relief(stride=stride, relief_scale=scene.relief_scale), scene
        )

    def with_materials(self, relief: Relief, scene: Scene) -> Surface:
        """``relief``, in pixels of the drawing, with the materials of ``scene``."""
        labels = self.layers.labels
        row, column = vertex_pixels(labels, relief.vertices / np.float32(self.step))
        albedo = self.layers.albedo_at(row, column)
        return assign_materials(relief, albedo, labels[row, column], self.layers.palette, scene)


def block_middles(plane: NDArray[Sample], step: int) -> NDArray[Sample]:
    """The middle pixel of each block of ``step`` x ``step`` pixels, (H, W, ...)."""
    return plane[step // 2 :: step, step // 2 :: step] if step > 1 else plane


def character_box(mask: NDArray[np.bool_], step: int) -> Box:
    """A box around ``mask``, (H, W) bool, with a margin. One pixel of the mask is ``step`` units of
    the box."""
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    left, top = int(columns[0]) - 2, int(rows[0]) - 2
    width, height = int(columns[-1]) + 3 - left, int(rows[-1]) + 3 - top
    return float(left * step), float(top * step), float(width * step), float(height * step)
