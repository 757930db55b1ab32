"""Measures networks and other methods on the same drawings, with exact truth."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lampblack.errors import LampblackError
from lampblack.normals.silhouette import flat_normals, inflated_normals, lumo_normals

from ..dataset.models import find_models
from .depth_meter import DepthMeter
from .drawings import Lines, TestDrawing, drawings
from .laigter import laigter_normals
from .lumo_mixed import lumo_mixed_normals
from .metrics import Errors, bootstrap, means, measure
from .surfaces import Method

PEERS: dict[str, Method] = {
    "flat": lambda lines, mask: flat_normals(mask),
    "laigter": lambda lines, mask: laigter_normals(mask),
    "laigter-tuned": lambda lines, mask: laigter_normals(mask, None),
    "inflate": lambda lines, mask: inflated_normals(mask),
    "lumo": lambda lines, mask: lumo_normals(mask),
    "lumo-mixed": lumo_mixed_normals,
}
"""Methods that learn nothing: each maps lines (H, W) and mask (H, W) to normals (H, W, 3)."""


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
    most: int | None = None,
    depth: bool = False,
    marks: bool = False,
    clicks: bool = False,
    progress: Callable[[float], None] = lambda share: None,
    on_drawing: Callable[[TestDrawing, dict[str, NDArray[np.float32]]], None] | None = None,
) -> dict[str, dict[str, float]]:
    """For every method: means over drawings of ``metrics.Errors``, and seconds for a picture. For
    all but the first: by how many percent the first method's angle is lower, with its 95 %
    interval over models.

    Args:
        most: largest number of drawings, evenly chosen of all.
        depth: measure the surfaces too (see ``DepthMeter``): more columns, and rows of its own
            with these columns only.
        marks: with ``depth``, measure also what hatching, stripes and spots do.
        clicks: with ``depth``, measure also what one correct click a drawing does.
        on_drawing: called with each drawing and the normals of every method.

    Raises:
        LampblackError: no models are found, or none can be drawn.
    """
    paths = find_models(models, split)
    meter = DepthMeter(character_px, marks=marks, clicks=clicks) if depth else None
    contenders = {name: Contender(method) for name, method in methods.items()}
    seen: list[str] = []
    total = min(len(paths) * views, most or len(paths) * views)
    for drawing in drawings(paths, views, character_px, lines, most=most):
        normals = {}
        for name, contender in contenders.items():
            began = time.perf_counter()
            normals[name] = contender.method(drawing.lines, drawing.mask)
            contender.seconds.append(time.perf_counter() - began)
            contender.errors.append(measure(normals[name], drawing.truth, drawing.mask))
        if meter is not None:
            meter.add(drawing, methods, normals)
        seen.append(drawing.model)
        if on_drawing is not None:
            on_drawing(drawing, normals)
        progress(min(1.0, len(seen) / total))
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
    for name, figures in (meter.rows() if meter else {}).items():
        table[name] = table.get(name, {}) | figures
    return table
