"""Time and noise of a final frame, with the floor and without."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from ..cache import ArrayCache
from ..composite import composite
from ..drawing import decompose_drawing
from ..pipeline import Pipeline
from ..render import QUALITIES, frame_request
from ..render.quality import REFERENCE
from ..scene import Floor, Scene
from .memory import peak_gib


def bench_final(picture: NDArray[np.uint8], scene: Scene, *, reference: bool) -> dict[str, float]:
    """Wall seconds of one final frame (nothing cached, renderer started), for the scene without
    a floor and with one. With ``reference`` also the rmse (sRGB, 0 to 1, over white, where either
    picture is not empty) against 512 samples per pixel.

    Args:
        picture: (H, W, 4) uint8. scene: lights and materials; its quality is ignored.
    """
    figures: dict[str, float] = {}
    for name, floor in (("no_floor", None), ("floor", scene.floor or _default_floor(picture))):
        staged = replace(scene, floor=floor, quality="final")
        with TemporaryDirectory() as folder, Pipeline(ArrayCache(Path(folder))) as pipeline:
            pipeline.warm_up()
            begin = time.perf_counter()
            drawing = decompose_drawing(picture)
            result = pipeline.render(drawing, staged)
            figures[f"seconds_final_{name}"] = round(time.perf_counter() - begin, 2)
            begin = time.perf_counter()
            pipeline.render(drawing, _moved(staged))
            figures[f"seconds_relight_{name}"] = round(time.perf_counter() - begin, 2)
            if reference:
                prepared = pipeline.prepare(drawing)
                surface = prepared.surface(staged, QUALITIES[staged.quality].mesh_stride)
                request = replace(frame_request(drawing.size, surface, staged), quality=REFERENCE)
                truth = composite(drawing, pipeline.renderer.render(request), staged)
                figures[f"rmse_final_{name}"] = round(_rmse(result, truth), 5)
    return figures | {"peak_memory_gib": peak_gib()}


def _rmse(a: NDArray[np.uint8], b: NDArray[np.uint8]) -> float:
    """Root mean square error over the pixels that either picture covers, composited on white."""
    one, other = (1 + (p[..., :3] / 255.0 - 1) * (p[..., 3:] / 255.0) for p in (a, b))
    covered = (a[..., 3] > 0) | (b[..., 3] > 0)
    return float(np.sqrt(np.square(one - other)[covered].mean()))


def _moved(scene: Scene) -> Scene:
    """Move every light by one pixel, so that none of them is cached."""
    lights = tuple(replace(light, x=light.x + 1) for light in scene.lights)
    return replace(scene, lights=lights)


def _default_floor(picture: NDArray[np.uint8]) -> Floor:
    drawn = np.flatnonzero((picture[..., 3] > 0).any(axis=1))
    return Floor(float(drawn[-1] if len(drawn) else picture.shape[0]))
