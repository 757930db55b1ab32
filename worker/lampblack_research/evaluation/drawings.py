"""Test drawings: every model from evenly spread sides, the same at every run."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from lampblack.errors import LampblackError

from ..dataset.freestyle import Stroke, draw_freestyle
from ..dataset.gbuffer import place, trace_placed, view_rotation
from ..dataset.linework import LineStyle, draw_lines
from ..dataset.models import load_model
from ..dataset.smooth import smoothed

Lines = Literal["freestyle", "gbuffer"]


@dataclass(frozen=True)
class TestDrawing:
    """A drawing and its truth.

    Attributes:
        lines: (H, W) float32 ink in 0..1, to predict from; mask: (H, W) bool, likewise.
        truth: (H, W, 3) float32 normals, unit in the mask.
        depth: (H, W) float32, pixels towards the viewer, nan outside the mask.
        vertices: (V, 3) float32 of the mesh: pixels, x right, y up from the lower left corner of
            the picture, z to the viewer.
        faces: (F, 3) int32, the sheets that are hidden behind others included.
    """

    __test__ = False

    model: str
    lines: NDArray[np.float32]
    mask: NDArray[np.bool_]
    truth: NDArray[np.float32]
    depth: NDArray[np.float32]
    vertices: NDArray[np.float32]
    faces: NDArray[np.int32]


def drawings(
    paths: list[Path],
    views: int,
    character_px: int,
    lines: Lines,
    seed: int = 0,
    most: int | None = None,
) -> Iterator[TestDrawing]:
    """``views`` drawings of each model; models that cannot be read are left out. Of all of them,
    at most ``most``, evenly chosen, so that models and sides vary."""
    every = len(paths) * views
    chosen = set(np.linspace(0, every - 1, min(every, most or every)).round().astype(int).tolist())
    for index, path in enumerate(paths):
        sides = [side for side in range(views) if index * views + side in chosen]
        try:
            model = smoothed(load_model(path)) if sides else None
        except LampblackError:
            continue
        if model is None:
            continue
        placed, randoms = [], []
        for side in sides:
            rng = np.random.default_rng([seed, side])
            azimuth, elevation = 360.0 * side / views, float(rng.uniform(-5, 30))
            placed.append(place(model, view_rotation(azimuth, elevation), character_px))
            randoms.append(rng)
        inked: list[NDArray[np.float32] | None] = [None] * len(sides)
        if lines == "freestyle":
            strokes = [
                replace(Stroke.random(rng, character_px), seed=side)
                for side, rng in zip(sides, randoms, strict=True)
            ]
            inked = draw_freestyle(list(zip(placed, strokes, strict=True)))
        for character, rng, ink in zip(placed, randoms, inked, strict=True):
            view = trace_placed(character)
            if not view.mask.any():
                continue
            if lines == "gbuffer":
                ink = draw_lines(view, LineStyle.random(rng, character_px), rng)
            if ink is not None:
                yield TestDrawing(
                    model=model.name,
                    lines=ink * view.mask,
                    mask=view.mask,
                    truth=view.normals,
                    depth=np.where(view.mask, view.depth, np.float32(np.nan)),
                    vertices=character.vertices,
                    faces=model.faces,
                )
