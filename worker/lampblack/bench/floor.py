"""What relighting cannot be faster than: Cycles alone, without socket, denoiser or composite."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from ..cache import ArrayCache
from ..camera import IDENTITY
from ..pipeline import Pipeline
from ..protocol import frame_digest
from ..render import RenderChild
from ..scene import Scene
from ..service.model import coarse_model
from ..service.snapshot import Look, Snapshot
from ..service.source import LADDERS, MOVING, Source, sources_of

RENDERS = 15


def cycles_alone(picture: NDArray[np.uint8], scene: Scene) -> dict[str, float]:
    """Median ms of one moved light traced, by its size and samples, with and without the
    denoiser."""
    planes = {"pixels": picture}
    digest = frame_digest(planes)  # type: ignore[arg-type]
    with TemporaryDirectory() as folder, Pipeline(ArrayCache(Path(folder))) as pipeline:
        model = coarse_model(digest, planes, pipeline)  # type: ignore[arg-type]
    crop = (0.0, 0.0, float(picture.shape[1]), float(picture.shape[0]))
    look = Look(1, 1, "lit", crop, (500, 500))
    source = sources_of(Snapshot("", look, digest, IDENTITY, 1, scene), model)[0]
    figures: dict[str, float] = {}
    with RenderChild() as child:
        surface = model.surface(scene)

        def trace(moved: Source, *, develop: bool) -> float:
            begin = time.perf_counter()
            child.expose(surface, moved.exposure(rung, 0, 1, develop=develop))
            return time.perf_counter() - begin

        for rung in (*MOVING, LADDERS["light"][0]):
            for develop, name in ((False, "cycles"), (True, "cycles_and_denoiser")):
                taken = [trace(_moved(source, n), develop=develop) for n in range(RENDERS)]
                figures[f"ms_{name}_{rung.longest}px_1spp"] = float(np.median(taken[3:]) * 1000)
    return figures


def _moved(source: Source, step: int) -> Source:
    assert source.light is not None
    return replace(source, light=replace(source.light, x=source.light.x + 20 * step))
