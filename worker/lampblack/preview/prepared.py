"""A drawing prepared to be lit: its layers, its height, and its surface."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..composite.sheet import Box, Sheet, sheet_of
from ..drawing import Drawing, DrawingPlanes
from ..pipeline import Pipeline, surface_step
from ..render import Surface, assign_materials, vertex_pixels
from ..scene import Scene
from ..surface import build_relief, solve

QUICK_PX = 500
"""Longest side at which a new drawing is first shown."""
VERTICES = 250
"""Vertices along the longer side of a preview's relief."""

Detail = Literal["quick", "full"]


@dataclass(frozen=True)
class PreparedDrawing:
    """One drawing, ready to be lit.

    Attributes:
        digest: of the drawing.
        detail: quick is small, and its normals are of quick quality.
        size: (width, height) of the drawing.
        step: pixels of the drawing per pixel of ``sheet``.
        sheet: its layers.
        height: (h, w) float32, pixels of the drawing. mask: (h, w) bool.
        normals: (h, w, 3) uint8, (n + 1) / 2 x 255; 0 outside the mask.
        box: around the character, pixels of the drawing.
    """

    digest: str
    detail: Detail
    size: tuple[int, int]
    step: int
    sheet: Sheet
    height: NDArray[np.float32]
    mask: NDArray[np.bool_]
    normals: NDArray[np.uint8]
    box: Box

    @property
    def nbytes(self) -> int:
        """Memory it takes."""
        return self.sheet.nbytes + self.height.nbytes + self.mask.nbytes + self.normals.nbytes

    def surface(self, scene: Scene) -> Surface:
        """The relief, in pixels of the drawing, in the materials of ``scene``."""
        height, width = self.height.shape
        scale = self.size[0] / width
        relief = build_relief(
            self.height / np.float32(scale),
            self.mask,
            stride=max(1, round(max(height, width) / VERTICES)),
            relief_scale=scene.relief_scale,
        )
        relief = replace(relief, vertices=relief.vertices * np.float32(scale))
        row, column = vertex_pixels(self.sheet.labels, relief.vertices / np.float32(self.step))
        albedo = self.sheet.albedo[row, column].astype(np.float32) / 255
        return assign_materials(
            relief, albedo, self.sheet.labels[row, column], self.sheet.palette, scene
        )


def prepare_quick(digest: str, planes: DrawingPlanes, pipeline: Pipeline) -> PreparedDrawing:
    """Prepare a drawing within a fraction of a second: small, from normals of quick quality.

    Raises:
        DrawingError: there is nothing to light.
    """
    height, width = planes.pixels.shape[:2]
    step = -(-max(width, height) // QUICK_PX)
    drawing = planes.reduced(step).decompose()
    lines, mask = _halved(drawing)
    normals = pipeline.quick_normals(lines, mask)
    heights = solve(normals, mask) * np.float32(width / mask.shape[1])
    return _prepared(digest, "quick", (width, height), step, drawing, mask, normals, heights)


def prepare_full(digest: str, drawing: Drawing, pipeline: Pipeline) -> PreparedDrawing:
    """Prepare a drawing as finals are, from normals of default quality."""
    heights, normals, mask = pipeline.height(drawing), pipeline.normals(drawing), drawing.mask
    stride = surface_step(drawing)
    if stride > 1:
        rows, columns = heights.shape
        middle = np.s_[stride // 2 :: stride, stride // 2 :: stride]
        mask, normals = mask[middle][:rows, :columns], normals[middle][:rows, :columns]
    return _prepared(digest, "full", drawing.size, 1, drawing, mask, normals, heights)


def _prepared(
    digest: str,
    detail: Detail,
    size: tuple[int, int],
    step: int,
    drawing: Drawing,
    mask: NDArray[np.bool_],
    normals: NDArray[np.float32],
    heights: NDArray[np.float32],
) -> PreparedDrawing:
    rows, columns = (np.flatnonzero(drawing.mask.any(axis=axis)) for axis in (1, 0))
    left, top = columns[0] - 2, rows[0] - 2
    box = (left, top, columns[-1] + 3 - left, rows[-1] + 3 - top)
    shown = np.rint((normals + 1) * 127.5) * mask[..., None]
    return PreparedDrawing(
        digest=digest,
        detail=detail,
        size=size,
        step=step,
        sheet=sheet_of(drawing),
        height=heights,
        mask=mask,
        normals=shown.astype(np.uint8),
        box=(
            float(box[0] * step),
            float(box[1] * step),
            float(box[2] * step),
            float(box[3] * step),
        ),
    )


def _halved(drawing: Drawing) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """Lines and mask at half the size; of a character too fine for that, as they are."""
    size = max(1, drawing.size[0] // 2), max(1, drawing.size[1] // 2)
    cover = Image.fromarray(drawing.mask.astype(np.uint8) * 255)
    mask = np.asarray(cover.resize(size, Image.Resampling.BOX)) > 96
    if not mask.any():
        return drawing.lines, drawing.mask
    lines = Image.fromarray(drawing.lines).resize(size, Image.Resampling.BOX)
    return np.asarray(lines), mask
