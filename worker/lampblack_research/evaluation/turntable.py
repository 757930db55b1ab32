"""Measures flicker with known truth, on turntables of models."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from lampblack.cache import ArrayCache
from lampblack.normals.predict import NormalPredictor
from lampblack.normals.temporal.neighbours import REACH
from lampblack.normals.temporal.temporal_filter import Neighbours, TemporalFilter
from lampblack.normals.temporal.thumbnail import RegistrationThumbnail, make_thumbnail
from lampblack.pipeline import Pipeline

from ..dataset.gbuffer import GBuffer, place, trace_placed, view_rotation
from ..dataset.linework import LineStyle, draw_lines
from ..dataset.models import Model, load_model
from .flicker import lazy_neighbours, rigid_change
from .flips import Carry, FlipMeter, Flips
from .surfaces import ink_drawing

STEP_DEGREES = 5.0
_ELEVATION = 10.0
_OCCLUDED_PX = 3.0

Normals = NDArray[np.float32]


@dataclass(frozen=True)
class TurntableErrors:
    """Means over a turntable, in degrees.

    Attributes:
        error: between the normals and the truth.
        change: from view to view at the points of the model, after its turn is removed. Of the
            truth it is 0, except for sampling.
        jitter: departure from the mean of the views before and after, at the points of the model.
        rigid: change after the rigid motion in the picture is removed. It includes the turn of the
            model, also for the truth.
        cuts, swaps, flips: see ``Flips``. Those of the truth come and go as the model turns.
    """

    error: float
    change: float
    jitter: float
    rigid: float
    cuts: float
    swaps: float
    flips: float


@dataclass(frozen=True)
class View:
    """One view; ``to_pixels`` (3, 3) and ``shift`` (3,) take the model's points to pixels,
    x right, y up from the lower left corner, z to the viewer."""

    rotation: NDArray[np.float32]
    to_pixels: NDArray[np.float32]
    shift: NDArray[np.float32]
    seen: GBuffer
    lines: NDArray[np.float32]


def turntable(
    path: Path,
    predictor: NormalPredictor,
    *,
    views: int = 12,
    character_px: int = 448,
    seed: int = 0,
) -> dict[str, TurntableErrors]:
    """Measure truth, predictions and smoothed predictions of one model.

    It is drawn in one line style at ``views`` steps of five degrees, its front in the middle.
    """
    turned = _views(load_model(path), views, character_px, seed)
    predicted = [predictor.predict(view.lines, view.seen.mask).normals for view in turned]
    with TemporaryDirectory(prefix="lampblack-") as folder:
        pipeline = Pipeline(ArrayCache(Path(folder)), predictor=predictor)
        drawn = [ink_drawing(view.lines, view.seen.mask) for view in turned]
        small = [pipeline.surfaces.thumbnail(drawing) for drawing in drawn]
        heights = {
            "truth": [view.seen.depth for view in turned],
            "predicted": [pipeline.prepare(drawing).height for drawing in drawn],
            "steadied": [
                pipeline.prepare(drawing, lazy_neighbours(around)).height
                for drawing, around in zip(drawn, _neighbours(small), strict=True)
            ],
        }
    rows = {
        "truth": [view.seen.normals for view in turned],
        "predicted": predicted,
        "steadied": _smoothed(turned, predicted),
    }
    return {name: _measure(turned, rows[name], heights[name]) for name in rows}


def _views(model: Model, count: int, character_px: int, seed: int) -> list[View]:
    rotations = [
        view_rotation(STEP_DEGREES * (index - (count - 1) / 2), _ELEVATION)
        for index in range(count)
    ]
    # One scale for all views, so that the character keeps its size as it turns.
    spans = [np.ptp(model.vertices @ r.T, axis=0)[:2].max() for r in rotations]
    style = LineStyle.random(np.random.default_rng(seed), character_px)
    turned = []
    for index, (rotation, span) in enumerate(zip(rotations, spans, strict=True)):
        placed = place(model, rotation, round(character_px * float(span / max(spans))))
        upright = model.vertices @ rotation.T
        scale = np.ptp(placed.vertices[:, 1]) / np.ptp(upright[:, 1])
        seen = trace_placed(placed)
        turned.append(
            View(
                rotation=rotation,
                to_pixels=scale * rotation,
                shift=placed.vertices[0] - scale * upright[0],
                seen=seen,
                lines=draw_lines(seen, style, np.random.default_rng([seed, index])),
            )
        )
    return turned


def _neighbours(small: Sequence[RegistrationThumbnail]) -> list[Neighbours]:
    return [
        Neighbours(tuple(small[max(0, i - REACH) : i][::-1]), tuple(small[i + 1 :][:REACH]))
        for i in range(len(small))
    ]


def _smoothed(views: Sequence[View], predicted: Sequence[Normals]) -> list[Normals]:
    temporal_filter, small = TemporalFilter(), _small(views, predicted)
    return [
        temporal_filter.smooth(normals, view.seen.mask, here, around)
        for normals, view, here, around in zip(
            predicted, views, small, _neighbours(small), strict=True
        )
    ]


def _small(views: Sequence[View], normals: Sequence[Normals]) -> list[RegistrationThumbnail]:
    return [
        make_thumbnail(str(index), view.lines, view.seen.mask, np.ones_like(shown), shown)
        for index, (view, shown) in enumerate(zip(views, normals, strict=True))
    ]


def _measure(
    views: Sequence[View], normals: Sequence[Normals], heights: Sequence[NDArray[np.float32]]
) -> TurntableErrors:
    error, change, jitter = [], [], []
    rigid = [rigid_change(here, later) for here, later in pairwise(_small(views, normals))]
    for i, view in enumerate(views):
        mask = view.seen.mask
        error.append(_angle(normals[i][mask], view.seen.normals[mask]))
        around = [
            (_followed(view, views[k]), normals[k], views[k].rotation)
            for k in (i - 1, i + 1)
            if 0 <= k < len(views)
        ]
        carried = []
        for index, other, rotation in around:
            found = np.full(normals[i].shape, np.nan, np.float32)
            met = index >= 0
            found[met] = other.reshape(-1, 3)[index[met]] @ rotation @ view.rotation.T
            carried.append(found)
        if i + 1 < len(views):
            met = np.isfinite(carried[-1][..., 0])
            change.append(_angle(normals[i][met], carried[-1][met]))
        if len(carried) == 2:
            mean = carried[0] + carried[1]
            met = np.isfinite(mean[..., 0])
            jitter.append(_angle(normals[i][met], mean[met]))
    return TurntableErrors(
        error=float(np.mean(error)),
        change=float(np.mean(change)),
        jitter=float(np.mean(jitter)),
        rigid=float(np.mean(rigid)),
        **_flips(views, heights)._asdict(),
    )


def _flips(views: Sequence[View], heights: Sequence[NDArray[np.float32]]) -> Flips:
    meter = FlipMeter()
    for last, view, height in zip((None, *views), views, heights, strict=False):
        meter.add(
            np.where(view.seen.mask, height, np.float32(np.nan)),
            None if last is None else _carry(last, view),
            None if last is None else _carry(view, last),
        )
    return meter.flips


def _carry(view: View, other: View) -> Carry:
    """Points of the model, from view to view; nan where they are hidden or beyond the model."""
    index, width = _followed(view, other), other.seen.mask.shape[1]

    def carry(points: NDArray[np.float32]) -> NDArray[np.float32]:
        column, row = np.floor(points).astype(int).T
        found = index[np.clip(row, 0, len(index) - 1), np.clip(column, 0, index.shape[1] - 1)]
        there = np.column_stack([found % width + 0.5, found // width + 0.5]).astype(np.float32)
        there[found < 0] = np.nan
        return there

    return carry


def _followed(view: View, other: View) -> NDArray[np.int64]:
    """(H, W): flat index of the pixel of ``other`` that shows the same point; -1 if none does."""
    rows, columns = np.nonzero(view.seen.mask)
    height = view.seen.mask.shape[0]
    points = np.stack([columns + 0.5, height - (rows + 0.5), view.seen.depth[rows, columns]], 1)
    # The matrices are rotations with a scale, so that inverse is transpose over its square.
    square = float((view.to_pixels[0] ** 2).sum())
    there = (points - view.shift) @ view.to_pixels / square @ other.to_pixels.T + other.shift
    size = other.seen.mask.shape
    row = np.floor(size[0] - there[:, 1]).astype(np.int64)
    column = np.floor(there[:, 0]).astype(np.int64)
    on_canvas = (row >= 0) & (row < size[0]) & (column >= 0) & (column < size[1])
    row, column = np.clip(row, 0, size[0] - 1), np.clip(column, 0, size[1] - 1)
    near = np.abs(other.seen.depth[row, column] - there[:, 2]) < _OCCLUDED_PX
    shown = on_canvas & near & other.seen.mask[row, column]
    index = np.full(view.seen.mask.shape, -1, np.int64)
    index[rows[shown], columns[shown]] = row[shown] * size[1] + column[shown]
    return index


def _angle(a: Normals, b: Normals) -> float:
    length = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    cosine = np.einsum("nc,nc->n", a, b) / np.maximum(length, 1e-6)
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean())
