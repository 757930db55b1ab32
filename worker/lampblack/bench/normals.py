"""Time from a drawing to its normal map and its mesh."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray

from ..choices import DEFAULT_GRIDS
from ..drawing import decompose_drawing
from ..normals.predict import NormalPredictor
from ..normals.predict_tiles import PAPER_GRIDS
from ..surface import build_relief, dividing_lines, guided_filter, solve_with_overlaps


def bench_normals(picture: NDArray[np.uint8], runs: int = 5) -> dict[str, float]:
    """Milliseconds of each stage up to the mesh, at the default quality, network loaded.

    Args:
        picture: (H, W, 4) uint8.
        runs: how often the default is timed, after one warm-up.
    """
    predictor = NormalPredictor()
    stages: dict[str, list[float]] = {}

    def timed(name: str, since: float) -> float:
        now = time.perf_counter()
        stages.setdefault(name, []).append(1000 * (now - since))
        return now

    for run in range(runs + 1):
        if run == 1:
            stages.clear()  # the first run warms up
        begin = moment = time.perf_counter()
        drawing = decompose_drawing(picture)
        moment = timed("take_apart", moment)
        prediction = predictor.predict(drawing.lines, drawing.mask)
        moment = timed("normals", moment)
        lines = dividing_lines(drawing.lines, drawing.ink, drawing.mask)
        height, _ = solve_with_overlaps(prediction, drawing.mask, lines)
        height = guided_filter(height, drawing.mask)
        moment = timed("surface", moment)
        build_relief(height, drawing.mask)
        moment = timed("mesh", moment)
        moment = timed("drawing_to_mesh", begin)
        predictor.predict(drawing.lines, drawing.mask, quick=True)
        timed("normals_quick", moment)
    begin = time.perf_counter()
    predictor.predict(drawing.lines, drawing.mask, grids=PAPER_GRIDS)
    figures = {f"ms_{name}_p50": float(np.median(times)) for name, times in stages.items()}
    figures["ms_drawing_to_mesh_max"] = max(stages["drawing_to_mesh"])
    figures["ms_normals_20_grids"] = 1000 * (time.perf_counter() - begin)
    figures = {name: round(value, 1) for name, value in figures.items()}
    return figures | {"grids": DEFAULT_GRIDS, "masked_pixels": int(drawing.mask.sum())}
