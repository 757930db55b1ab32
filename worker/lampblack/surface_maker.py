"""Drawing -> normals -> height, each kept in the cache by what it was made from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .cache import ArrayCache, Arrays, digest
from .choices import DEFAULT_GRIDS, PipelineOptions
from .corrected import bend_strokes, corrections_of
from .drawing import Drawing
from .drawing.morphology import from_nearest
from .hints import hints_by_body, scaled_hint
from .normals.bend_strokes import BendStroke
from .normals.network import has_torch, soon_loaded_network
from .normals.predict import NormalPredictor
from .normals.prediction import Prediction, pack_order, unpack_order
from .normals.temporal.temporal_filter import LazyNeighbours, TemporalFilter, body_neighbours
from .normals.temporal.thumbnail import RegistrationThumbnail, make_thumbnail
from .prepared import block_middles
from .scene import DepthColour, DepthHint, Hint
from .surface import (
    Overlap,
    dividing_lines,
    guided_filter,
    overlap_votes,
    solve,
    solve_with_overlaps,
)
from .surface.cuts import Cuts
from .surface.overlap import pack_overlaps, unpack_overlaps

MAX_SURFACE_PX = 2048
"""Longest side at which a surface is solved; larger pictures are lit at this size."""

Progress = Callable[[float], None]


def no_progress(share: float) -> None:
    """For callers that show none."""


class Predictor(Protocol):
    """Predicts normals and depth; see ``NormalPredictor``."""

    @property
    def identity(self) -> str:
        """A digest of the weights."""

    def predict(
        self,
        lines: NDArray[np.float32],
        mask: NDArray[np.bool_],
        *,
        grids: int = DEFAULT_GRIDS,
        quick: bool = False,
        strokes: Sequence[BendStroke] = (),
        progress: Progress = no_progress,
    ) -> Prediction:
        """The prediction for one drawing; see ``NormalPredictor.predict``."""


class SurfaceMaker:
    """Makes the normals and the height of drawings, or finds them in the cache.

    Args:
        predictor: None is the shipped network, loaded when it is needed.
    """

    def __init__(
        self, cache: ArrayCache, options: PipelineOptions, predictor: Predictor | None = None
    ) -> None:
        self._cache = cache
        self._predictor = self._first_look = predictor
        self._temporal_filter = TemporalFilter()
        self.options = options

    @property
    def predictor(self) -> Predictor:
        """The network; the first use loads it."""
        if self._predictor is None:
            self._predictor = NormalPredictor() if has_torch() else self.first_look
        return self._predictor

    @property
    def first_look(self) -> Predictor:
        """The network for quick normals, for which nobody wants to wait: the first use loads it
        soon."""
        if self._first_look is None:
            self._first_look = NormalPredictor(*soon_loaded_network())
        return self._first_look

    def normals(
        self,
        drawing: Drawing,
        neighbours: LazyNeighbours | None = None,
        hints: Sequence[Hint] = (),
        progress: Progress = no_progress,
    ) -> NDArray[np.float32]:
        """(H, W, 3) float32 normal map, x right, y up, z to the viewer; 0 outside the mask. With
        ``neighbours`` it passes the temporal filter. Of several bodies, the topmost is seen. Of
        ``hints``, in pixels of the drawing, those of round and hollow parts count."""
        if not drawing.bodies:
            return self._prediction(drawing, neighbours, hints, progress).normals
        seen = np.zeros((*drawing.mask.shape, 3), np.float32)
        own = hints_by_body(drawing.bodies, hints)
        for body, own_hints in zip(drawing.bodies, own, strict=True):
            around = body_neighbours(neighbours, body.name)
            normals = self.normals(body.drawing, around, own_hints, progress)
            inside = body.drawing.mask
            if body.rim.any():
                normals, inside = from_nearest(normals, inside), inside | body.rim
            rows, columns = inside.shape
            place = slice(body.top, body.top + rows), slice(body.left, body.left + columns)
            seen[place][inside] = normals[inside]
        return seen

    def height(
        self,
        drawing: Drawing,
        neighbours: LazyNeighbours | None = None,
        hints: Sequence[Hint] = (),
        progress: Progress = no_progress,
    ) -> tuple[NDArray[np.float32], tuple[Overlap, ...]]:
        """(h, w) float32 height in pixels of the drawing, at its size or less (see
        ``surface_step``), and the overlaps along which it steps. ``hints`` are in pixels of the
        drawing."""
        made_from = [self.predictor.identity, self.options, drawing.lines, drawing.mask]
        made_from.append(drawing.ink)
        if neighbours is not None:
            made_from += [drawing.albedo, neighbours.keys]
        if hints:
            # A stroke says the same whatever the frame on which it was drawn.
            made_from.append(
                repr([h if isinstance(h, DepthColour) else replace(h, frame=0) for h in hints])
            )
            made_from += [drawing.labels, drawing.palette.colours]

        def make() -> Arrays:
            height, overlaps = self._inflate(drawing, neighbours, hints, progress)
            return {"height": height, "overlaps": pack_overlaps(overlaps)}

        stored = self._cache.get(digest("height", *made_from), make)
        return stored["height"], unpack_overlaps(stored["overlaps"])

    def thumbnail(self, drawing: Drawing) -> RegistrationThumbnail:
        """The drawing's registration thumbnail, about 4 MB."""
        return _thumbnail(drawing, self._prediction(drawing))

    def _prediction(
        self,
        drawing: Drawing,
        neighbours: LazyNeighbours | None = None,
        hints: Sequence[Hint] = (),
        progress: Progress = no_progress,
    ) -> Prediction:
        """The prediction, its depth and edges at low resolution. What hints change is added to the
        steadied prediction without them: neighbours do not know them."""
        strokes = bend_strokes(hints)
        if neighbours is None:
            return self._predict(drawing, strokes, progress)
        prediction = self._predict(drawing, (), progress)
        here = _thumbnail(drawing, prediction)
        steady = self._temporal_filter.smooth_prediction(
            prediction, drawing.mask, here, neighbours.load()
        )
        if not strokes:
            return steady
        told = self._predict(drawing, strokes, progress)
        normals = steady.normals + told.normals - prediction.normals
        length = np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), np.float32(1e-6))
        return replace(steady, normals=normals / length)

    def _predict(
        self, drawing: Drawing, strokes: Sequence[BendStroke], progress: Progress
    ) -> Prediction:
        grids = self.options.grids

        def make() -> Arrays:
            made = self.predictor.predict(
                drawing.lines, drawing.mask, grids=grids, strokes=strokes, progress=progress
            )
            return {"normals": made.normals, "order": pack_order(made, drawing.mask)}

        made_from = [self.predictor.identity, grids, drawing.lines, drawing.mask]
        for stroke in strokes:
            made_from += [stroke.bend, stroke.points]
        stored = self._cache.get(digest("normals", *made_from), make)
        return unpack_order(stored["normals"], stored["order"], drawing.mask)

    def _inflate(
        self,
        drawing: Drawing,
        neighbours: LazyNeighbours | None,
        hints: Sequence[Hint],
        progress: Progress,
    ) -> tuple[NDArray[np.float32], list[Overlap]]:
        prediction = self._prediction(drawing, neighbours, hints, progress)
        mask = drawing.mask
        lines = dividing_lines(drawing.lines, drawing.ink, mask)
        step = surface_step(drawing)
        if step > 1:
            prediction, mask, lines = _shrink(prediction, mask, lines, step)
        corrections = corrections_of(drawing, mask, hints, step)
        if self.options.solver == "direct":
            sides = [scaled_hint(hint, 1 / step) for hint in hints if isinstance(hint, DepthHint)]
            height, overlaps = solve_with_overlaps(prediction, mask, lines, sides, corrections)
        else:
            height, overlaps = solve(prediction.normals, mask, solver=self.options.solver), []
            height = corrections.height(height, mask, Cuts.none(mask.shape))
        height = guided_filter(height, mask) * np.float32(step)
        return height, [
            replace(overlap, points=overlap.points * step, amount=overlap.amount * step)
            for overlap in overlaps
        ]


def surface_step(drawing: Drawing) -> int:
    """Canvas pixels per pixel of the surface: 1 up to ``MAX_SURFACE_PX``."""
    return -(-max(drawing.size) // MAX_SURFACE_PX)


def _thumbnail(drawing: Drawing, prediction: Prediction) -> RegistrationThumbnail:
    normals, depth, edge = prediction.normals, prediction.depth, prediction.edge
    order = None
    if depth is not None and edge is not None:
        lines = dividing_lines(drawing.lines, drawing.ink, drawing.mask)
        order = np.dstack([overlap_votes(prediction, drawing.mask, lines), depth, edge])
    name = digest(drawing.lines, drawing.mask, drawing.albedo, normals)
    return make_thumbnail(name, drawing.lines, drawing.mask, drawing.albedo, normals, order)


def _shrink(
    prediction: Prediction, mask: NDArray[np.bool_], lines: NDArray[np.float32], step: int
) -> tuple[Prediction, NDArray[np.bool_], NDArray[np.float32]]:
    """Blocks of ``step`` x ``step`` pixels as one: normals are averaged, and a line remains if any
    of its pixels is there. A block is inside if its middle pixel is."""
    rows, columns = mask.shape[0] // step, mask.shape[1] // step
    blocks = rows, step, columns, step
    whole = np.s_[: rows * step, : columns * step]
    pooled = prediction.normals[whole].reshape(*blocks, 3).mean(axis=(1, 3))
    darkest = lines[whole].reshape(blocks).max(axis=(1, 3))
    middle = block_middles(mask, step)[:rows, :columns]
    length = np.maximum(np.linalg.norm(pooled, axis=2, keepdims=True), 1e-6)
    normals = (pooled / length * middle[..., None]).astype(np.float32)
    depth, edge, votes = (
        None if plane is None else block_middles(plane, step)[:rows, :columns]
        for plane in (prediction.depth, prediction.edge, prediction.votes)
    )
    depth = None if depth is None else depth / np.float32(step)
    return Prediction(normals, depth, edge, votes), middle, darkest
