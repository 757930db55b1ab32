"""Prepare drawings to be lit: in full detail as for finals, or in quick detail for a first look."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from .corrected import corrected_normals
from .drawing import Drawing, DrawingPlanes
from .hints import hints_by_body
from .normals.temporal.temporal_filter import LazyNeighbours, body_neighbours
from .prepared import PreparedDrawing, block_middles, character_box
from .scene import Hint, LayerBody
from .stacked import seen_height, seen_normals, seen_overlaps, stack_bodies
from .surface import solve
from .surface_maker import Predictor, Progress, SurfaceMaker, no_progress, surface_step

QUICK_PX = 500
"""Longest side at which a drawing is prepared in quick detail."""


def prepare(
    surfaces: SurfaceMaker,
    drawing: Drawing,
    neighbours: LazyNeighbours | None = None,
    *,
    hints: Sequence[Hint] = (),
    digest: str = "",
    progress: Progress = no_progress,
    with_normals: bool = False,
) -> PreparedDrawing:
    """Prepare a drawing in full detail, as for finals.

    Args:
        neighbours: for the temporal filter of its normals.
        hints: what the artist says of its depth, in pixels of the drawing.
        digest: identifies the drawing.
        progress: called with the share done, 0 to 1, of predicting normals.
        with_normals: keep them in the result.
    """
    step = surface_step(drawing)
    if drawing.bodies:
        own = [
            prepare(
                surfaces,
                body.drawing,
                body_neighbours(neighbours, body.name),
                hints=own_hints,
                progress=progress,
            )
            for body, own_hints in zip(
                drawing.bodies, hints_by_body(drawing.bodies, hints), strict=True
            )
        ]
        bodies = stack_bodies(drawing.bodies, own, 1)
        rows, columns = (side // step for side in drawing.mask.shape)
        mask = block_middles(drawing.mask, step)[:rows, :columns]
        height, overlaps = seen_height(bodies, mask, step), seen_overlaps(bodies)
    else:
        bodies = ()
        height, overlaps = surfaces.height(drawing, neighbours, hints, progress)
        rows, columns = height.shape
        mask = block_middles(drawing.mask, step)[:rows, :columns]
    normals = surfaces.normals(drawing, neighbours, hints, progress) if with_normals else None
    if normals is not None:
        normals = corrected_normals(drawing, normals, height, hints, step)
    return PreparedDrawing(
        digest=digest,
        detail="full",
        size=drawing.size,
        step=1,
        layers=drawing,
        scale=float(step),
        height=height,
        mask=mask,
        normals=normals,
        box=character_box(drawing.mask, 1),
        overlaps=overlaps,
        bodies=bodies,
    )


def prepare_quick(
    predictor: Predictor,
    planes: DrawingPlanes,
    digest: str = "",
    choices: Sequence[LayerBody] = (),
) -> PreparedDrawing:
    """Prepare a drawing in quick detail, in a fraction of a second: small, from quick normals,
    which are neither cached nor filtered, and without overlaps. ``choices`` are the artist's, of
    the bodies of layers.

    Raises:
        DrawingError: there is nothing to light.
    """
    height, width = planes.pixels.shape[:2]
    step = -(-max(width, height) // QUICK_PX)
    drawing = planes.reduced(step).decompose(choices)
    if not drawing.bodies:
        return _quick(predictor, drawing, (width, height), step, digest)
    own = [
        _quick(predictor, b.drawing, (step * b.drawing.size[0], step * b.drawing.size[1]), step)
        for b in drawing.bodies
    ]
    bodies = stack_bodies(drawing.bodies, own, step)
    return PreparedDrawing(
        digest=digest,
        detail="quick",
        size=(width, height),
        step=step,
        layers=drawing,
        scale=float(step),
        height=seen_height(bodies, drawing.mask, step),
        mask=drawing.mask,
        normals=seen_normals(bodies, drawing.mask, step),
        box=character_box(drawing.mask, step),
        bodies=bodies,
    )


def _quick(
    predictor: Predictor, drawing: Drawing, size: tuple[int, int], step: int, digest: str = ""
) -> PreparedDrawing:
    """``drawing`` is a copy of one of ``size`` (width, height), smaller by ``step``."""
    width, height = size
    lines, mask = _halved(drawing)
    normals = predictor.predict(lines, mask, quick=True).normals
    scale = width / mask.shape[1]
    return PreparedDrawing(
        digest=digest,
        detail="quick",
        size=(width, height),
        step=step,
        layers=drawing,
        scale=scale,
        height=solve(normals, mask) * np.float32(scale),
        mask=mask,
        normals=normals,
        box=character_box(drawing.mask, step),
    )


def _halved(drawing: Drawing) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """Lines and mask at half the size, or at full size if nothing of the mask would remain."""
    size = max(1, drawing.size[0] // 2), max(1, drawing.size[1] // 2)
    cover = Image.fromarray(drawing.mask.astype(np.uint8) * 255)
    mask = np.asarray(cover.resize(size, Image.Resampling.BOX)) > 96
    if not mask.any():
        return drawing.lines, drawing.mask
    lines = Image.fromarray(drawing.lines).resize(size, Image.Resampling.BOX)
    return np.asarray(lines), mask
