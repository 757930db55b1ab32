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
    """``lines`` (H, W) float32 ink in 0..1 and ``mask`` (H, W) bool, to predict from; ``truth``
    (H, W, 3) float32, unit in the mask."""

    __test__ = False

    model: str
    lines: NDArray[np.float32]
    mask: NDArray[np.bool_]
    truth: NDArray[np.float32]


def drawings(
    paths: list[Path], views: int, character_px: int, lines: Lines, seed: int = 0
) -> Iterator[TestDrawing]:
    """``views`` drawings of each model; models that cannot be read are left out."""
    for path in paths:
        try:
            model = smoothed(load_model(path))
        except LampblackError:
            continue
        placed, randoms = [], []
        for side in range(views):
            rng = np.random.default_rng([seed, side])
            azimuth, elevation = 360.0 * side / views, float(rng.uniform(-5, 30))
            placed.append(place(model, view_rotation(azimuth, elevation), character_px))
            randoms.append(rng)
        inked: list[NDArray[np.float32] | None] = [None] * views
        if lines == "freestyle":
            strokes = [
                replace(Stroke.random(rng, character_px), seed=side)
                for side, rng in enumerate(randoms)
            ]
            inked = draw_freestyle(list(zip(placed, strokes, strict=True)))
        for character, rng, ink in zip(placed, randoms, inked, strict=True):
            view = trace_placed(character)
            if not view.mask.any():
                continue
            if lines == "gbuffer":
                ink = draw_lines(view, LineStyle.random(rng, character_px), rng)
            if ink is not None:
                yield TestDrawing(model.name, ink * view.mask, view.mask, view.normals)
