"""The lower bound on relighting: Cycles alone, without socket and composite."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from ..cache import ArrayCache
from ..camera import IDENTITY
from ..drawing import DrawingPlanes
from ..pipeline import Pipeline
from ..preview import LightContribution, Viewport, ViewRequest
from ..preview.contribution import preview_surface
from ..preview.refinement import MOVING, REFINEMENT
from ..preview.shape import DrawingShape
from ..render.client import RenderChild
from ..scene import Scene

RENDERS = 15


def cycles_alone(picture: NDArray[np.uint8], scene: Scene) -> dict[str, float]:
    """Median ms of tracing one moved light, by picture size and samples, with and without the
    denoiser."""
    with TemporaryDirectory() as folder, Pipeline(ArrayCache(Path(folder))) as pipeline:
        drawing = pipeline.prepare_quick(DrawingPlanes(picture))
    crop = (0.0, 0.0, float(picture.shape[1]), float(picture.shape[0]))
    viewport = Viewport(1, 1, "lit", crop, (500, 500))
    view = ViewRequest("", viewport, DrawingShape(""), IDENTITY, 1, scene).resolve(drawing)
    assert view is not None
    contribution = view.contributions[0]
    figures: dict[str, float] = {}
    with RenderChild() as child:
        surface = preview_surface(drawing, scene)

        def trace(moved: LightContribution, *, resolve: bool) -> float:
            begin = time.perf_counter()
            child.accumulate(surface, moved.accumulation(level, 0, 1, resolve=resolve))
            return time.perf_counter() - begin

        for level in (*MOVING, REFINEMENT["light"][0]):
            for resolve, name in ((False, "cycles"), (True, "cycles_and_denoiser")):
                taken = [trace(_moved(contribution, n), resolve=resolve) for n in range(RENDERS)]
                figures[f"ms_{name}_{level.longest}px_1spp"] = float(np.median(taken[3:]) * 1000)
    return figures


def _moved(contribution: LightContribution, step: int) -> LightContribution:
    assert contribution.light is not None
    light = replace(contribution.light, x=contribution.light.x + 20 * step)
    return replace(contribution, light=light)
