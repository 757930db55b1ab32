"""The surfaces of methods that are measured: heights, and the reliefs that cast shadows."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from lampblack.cache import ArrayCache
from lampblack.choices import DEFAULT_GRIDS, PipelineOptions
from lampblack.drawing import Drawing
from lampblack.drawing.palette import Palette, Swatch
from lampblack.normals.bend_strokes import BendStroke
from lampblack.normals.networks.torch_network import TorchNetwork
from lampblack.normals.predict import NormalPredictor
from lampblack.pipeline import Pipeline
from lampblack.surface import (
    Relief,
    build_relief,
    dividing_lines,
    guided_filter,
    solve,
    solve_with_overlaps,
)
from lampblack.surface_maker import MAX_SURFACE_PX

from ..dataset.gbuffer import MARGIN
from .clicks import best_correction

MAX_CHARACTER_PX = MAX_SURFACE_PX - 2 * MARGIN
"""Longest character whose surface is made at the size of the picture."""

Lines = NDArray[np.float32]
Mask = NDArray[np.bool_]
Normals = NDArray[np.float32]
Method = Callable[[Lines, Mask], Normals]
"""Maps lines (H, W) and mask (H, W) to normals (H, W, 3)."""


@dataclass(frozen=True)
class MeasuredSurface:
    """``height`` (H, W) float32, pixels towards the viewer; ``relief``, in canvas pixels."""

    height: NDArray[np.float32]
    relief: Relief


class NetworkMethod:
    """The shipped network, or that of a ``.safetensors`` file; ``grids`` as in ``predict``.

    Its surface is the product's: the whole path from the drawing to the height, with all defaults.
    """

    def __init__(self, weights: Path | None, grids: int = DEFAULT_GRIDS) -> None:
        predictor = NormalPredictor(*TorchNetwork.load(weights)) if weights else NormalPredictor()
        self._predictor, self._grids = predictor, grids
        folder = TemporaryDirectory(prefix="lampblack-")
        weakref.finalize(self, folder.cleanup)
        self._pipeline = Pipeline(
            ArrayCache(Path(folder.name), max_bytes=1 << 28),
            PipelineOptions(grids=grids),
            predictor=predictor,
        )

    def __call__(self, lines: Lines, mask: Mask, strokes: Sequence[BendStroke] = ()) -> Normals:
        """The predicted normals."""
        return self._predictor.predict(lines, mask, grids=self._grids, strokes=strokes).normals

    def surface(self, lines: Lines, mask: Mask) -> MeasuredSurface:
        """The surface of the drawing."""
        prepared = self._pipeline.prepare(ink_drawing(lines, mask))
        return MeasuredSurface(prepared.height, prepared.relief())

    def corrected(self, lines: Lines, mask: Mask, depth: NDArray[np.float32]) -> MeasuredSurface:
        """The surface after one correct click or stroke
        (``best_correction``); ``depth`` is the truth."""
        prediction = self._predictor.predict(lines, mask, grids=self._grids)
        dividing = dividing_lines(lines, lines, mask)
        height, overlaps = solve_with_overlaps(prediction, mask, dividing)
        click = best_correction(overlaps, guided_filter(height, mask), depth)
        if click is not None:
            height, _ = solve_with_overlaps(prediction, mask, dividing, (click,))
        return surface_of_height(guided_filter(height, mask), mask)


def surface_by(method: Method, lines: Lines, mask: Mask, normals: Normals) -> MeasuredSurface:
    """The surface of a method that gave ``normals``: its own, or else that of the normals
    alone."""
    if isinstance(method, NetworkMethod):
        return method.surface(lines, mask)
    return surface_of_normals(normals, mask)


def surface_of_normals(normals: Normals, mask: Mask) -> MeasuredSurface:
    """The surface of normals alone, by the product's solver."""
    return surface_of_height(guided_filter(solve(normals, mask), mask), mask)


def surface_of_height(height: NDArray[np.float32], mask: Mask) -> MeasuredSurface:
    """The surface of a known height."""
    return MeasuredSurface(height, build_relief(np.where(mask, height, np.float32(0)), mask))


def ink_drawing(lines: Lines, mask: Mask) -> Drawing:
    """A decomposed drawing of black ink on white, from (H, W) ``lines`` in 0..1 and ``mask``."""
    grey = np.round(255 * (1 - lines))
    return Drawing(
        pixels=np.dstack([grey, grey, grey, 255 * mask]).astype(np.uint8),
        mask=mask,
        coverage=mask.astype(np.float32),
        lines=lines,
        ink=lines,
        ink_colour=np.zeros((*mask.shape, 3), np.float32),
        albedo=np.ones((*mask.shape, 3), np.float32),
        labels=np.where(mask, 0, -1).astype(np.int16),
        palette=Palette((Swatch("#ffffff", int(np.count_nonzero(mask))),)),
    )
