"""Measures networks and other methods on the same drawings, with exact truth."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lampblack.choices import DEFAULT_GRIDS
from lampblack.errors import LampblackError
from lampblack.normals.card import load_network
from lampblack.normals.predict import NormalPredictor
from lampblack.normals.silhouette import flat_normals, inflated_normals, lumo_normals

from ..dataset.models import find_models
from .drawings import Lines, TestDrawing, drawings
from .laigter import laigter_normals
from .lumo_mixed import lumo_mixed_normals
from .metrics import Errors, bootstrap, means, measure

Method = Callable[[NDArray[np.float32], NDArray[np.bool_]], NDArray[np.float32]]

PEERS: dict[str, Method] = {
    "flat": lambda lines, mask: flat_normals(mask),
    "laigter": lambda lines, mask: laigter_normals(mask),
    "laigter-tuned": lambda lines, mask: laigter_normals(mask, None),
    "inflate": lambda lines, mask: inflated_normals(mask),
    "lumo": lambda lines, mask: lumo_normals(mask),
    "lumo-mixed": lumo_mixed_normals,
}
"""Methods that learn nothing: each maps lines (H, W) and mask (H, W) to normals (H, W, 3)."""


def network_method(weights: Path | None, grids: int = DEFAULT_GRIDS) -> Method:
    """The shipped network, or that of a ``.safetensors`` file; ``grids`` as in ``predict``."""
    predictor = NormalPredictor(*load_network(weights)) if weights else NormalPredictor()
    return lambda lines, mask: predictor.predict(lines, mask, grids=grids).normals


@dataclass
class Contender:
    """A method and its results, one for each drawing."""

    method: Method
    errors: list[Errors] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)


def evaluate(
    models: Path,
    split: str | None,
    methods: dict[str, Method],
    *,
    views: int = 8,
    character_px: int = 768,
    lines: Lines = "gbuffer",
    progress: Callable[[float], None] = lambda share: None,
    on_drawing: Callable[[TestDrawing, dict[str, NDArray[np.float32]]], None] | None = None,
) -> dict[str, dict[str, float]]:
    """For every method: means over drawings of ``metrics.Errors``, and seconds for a picture. For
    all but the first: by how many percent the first method's angle is lower, with its 95 %
    interval over models.

    Args:
        on_drawing: called with each drawing and the normals of every method.

    Raises:
        LampblackError: no models are found, or none can be drawn.
    """
    paths = find_models(models, split)
    contenders = {name: Contender(method) for name, method in methods.items()}
    seen: list[str] = []
    for drawing in drawings(paths, views, character_px, lines):
        normals = {}
        for name, contender in contenders.items():
            began = time.perf_counter()
            normals[name] = contender.method(drawing.lines, drawing.mask)
            contender.seconds.append(time.perf_counter() - began)
            contender.errors.append(measure(normals[name], drawing.truth, drawing.mask))
        seen.append(drawing.model)
        if on_drawing is not None:
            on_drawing(drawing, normals)
        progress(min(1.0, len(seen) / (len(paths) * views)))
    if not seen:
        raise LampblackError(f"Nothing could be drawn from the models in {models}.")
    table = {}
    first = next(iter(contenders.values()))
    for contender, name in zip(contenders.values(), contenders, strict=True):
        row = means(contender.errors) | {"seconds": round(float(np.median(contender.seconds)), 3)}
        if contender is not first:
            ours, theirs = ([e.mean for e in c.errors] for c in (first, contender))
            low, high = bootstrap(ours, theirs, seen)
            gain = 1 - float(np.mean(ours)) / float(np.mean(theirs))
            row |= {
                "first_is_better_percent": round(100 * gain, 2),
                "low_percent": round(100 * low, 2),
                "high_percent": round(100 * high, 2),
            }
        table[name] = row
    return table
