"""Angles between predicted and true normals, on models traced from many sides."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .gbuffer import trace, view_rotation
from .linework import Hand, draw_lines
from .models import find_models, load_model
from .predict import NormalPredictor
from .silhouette import flat_normals, inflated_normals, lumo_normals

Method = Callable[[NDArray[np.float32], NDArray[np.bool_]], NDArray[np.float32]]


def methods(predictor: NormalPredictor, grids: int) -> dict[str, Method]:
    """Each maps (lines (H, W), mask (H, W)) to normals (H, W, 3)."""
    return {
        "flat": lambda lines, mask: flat_normals(mask),
        "lumo": lambda lines, mask: lumo_normals(mask),
        "inflate": lambda lines, mask: inflated_normals(mask),
        "lampblack": lambda lines, mask: predictor.predict(lines, mask, grids=grids),
    }


def evaluate(
    models: Path,
    split: str | None,
    predictor: NormalPredictor,
    *,
    views: int = 8,
    figure_px: int = 512,
    grids: int = 5,
    seed: int = 0,
    progress: Callable[[float], None] = lambda share: None,
) -> dict[str, dict[str, float]]:
    """Mean over drawings of the mean and median angle in degrees, and of the tilt away from
    the viewer (mean angle between normal and view), for every method and for the truth.

    Raises:
        LampblackError: no models are found.
    """
    paths = find_models(models, split)
    contenders = methods(predictor, grids)
    found: dict[str, list[tuple[float, float, float]]] = {name: [] for name in contenders}
    truth_tilt = []
    drawings = _drawings(paths, views, figure_px, seed)
    for index, (lines, mask, truth) in enumerate(drawings):
        truth_tilt.append(_tilt(truth[mask]))
        for name, method in contenders.items():
            normals = method(lines, mask)[mask]
            angles = np.degrees(
                np.arccos(np.clip(np.einsum("nc,nc->n", normals, truth[mask]), -1, 1))
            )
            found[name].append((float(angles.mean()), float(np.median(angles)), _tilt(normals)))
        progress((index + 1) / (len(paths) * views))
    table = {}
    for name, rows in found.items():
        mean, median, tilt = np.mean(rows, axis=0)
        table[name] = {
            "mean_degrees": round(float(mean), 3),
            "median_degrees": round(float(median), 3),
            "tilt_degrees": round(float(tilt), 3),
        }
    table["truth"] = {"tilt_degrees": round(float(np.mean(truth_tilt)), 3)}
    return table


def _tilt(normals: NDArray[np.float32]) -> float:
    return float(np.degrees(np.arccos(np.clip(normals[:, 2], -1, 1))).mean())


def _drawings(
    paths: list[Path], views: int, figure_px: int, seed: int
) -> Iterator[tuple[NDArray[np.float32], NDArray[np.bool_], NDArray[np.float32]]]:
    """The same drawings every time: sides spread evenly around each model."""
    for number, path in enumerate(paths):
        model = load_model(path)
        for side in range(views):
            rng = np.random.default_rng([seed, number, side])
            azimuth, elevation = 360.0 * side / views, float(rng.uniform(-5, 30))
            view = trace(model, view_rotation(azimuth, elevation), figure_px)
            lines = draw_lines(view, Hand.random(rng, figure_px), rng)
            yield lines, view.mask, view.normals
