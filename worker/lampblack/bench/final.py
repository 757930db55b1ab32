"""Cost and noise of a final frame, with the floor and without."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..cache import ArrayCache
from ..composite import composite
from ..drawing import decompose_drawing
from ..pipeline import Pipeline
from ..render.client import RenderChild
from ..render.passes import Passes
from ..render.quality import QUALITIES, REFERENCE
from ..render.request import frame_request
from ..scene import Floor, Scene
from .memory import peak_gib, processor_seconds

FINAL = QUALITIES["final"]

Result = TypeVar("Result")


def bench_final(picture: NDArray[np.uint8], scene: Scene, *, reference: bool) -> dict[str, float]:
    """Cost of one final frame (nothing cached, renderer started), for the scene without a floor and
    with one, and of the same drawing under moved lights.

    Args:
        picture: (H, W, 4) uint8. scene: lights and materials; its quality is ignored.
        reference: measure also the rmse (sRGB, 0 to 1, over white, where either picture is not
            empty) against 512 samples per pixel.

    Returns:
        ``seconds_*``: wall seconds of the frame, and of each of its stages;
        ``processor_*``: processor seconds of the stages, and of the renderer's activities. The sum
        for Cycles and denoiser is the least that these samples cost.
    """
    figures: dict[str, float] = {}
    for name, floor in (("no_floor", None), ("floor", scene.floor or _default_floor(picture))):
        staged = replace(scene, floor=floor, quality="final")
        found = _frame(picture, staged, reference=reference)
        figures |= {f"{key}_{name}": value for key, value in found.items()}
    return figures | {"peak_memory_gib": peak_gib()}


def _frame(picture: NDArray[np.uint8], scene: Scene, *, reference: bool) -> dict[str, float]:
    renderer = RenderChild()
    with (
        TemporaryDirectory() as folder,
        Pipeline(ArrayCache(Path(folder)), renderer=renderer) as pipeline,
    ):
        pipeline.warm_up()
        cost = _Cost(renderer)
        drawing = cost.of("decompose", lambda: decompose_drawing(picture))
        prepared = cost.of("prepare", lambda: pipeline.prepare(drawing))
        surface = cost.of("mesh", lambda: prepared.surface(scene, FINAL.mesh_stride))

        def composited(passes: Passes) -> NDArray[np.uint8]:
            edges, form = prepared.edges_for(scene), prepared.form_for(scene)
            return composite(drawing, passes, scene, edges=edges, form=form)

        passes = cost.of("render", lambda: pipeline.light(prepared, scene, surface, mixed=True))
        result = cost.of("composite", lambda: composited(passes))
        figures = cost.figures()
        begin = time.perf_counter()
        composited(pipeline.light(prepared, _moved(scene), surface, mixed=True))
        figures["seconds_relight"] = time.perf_counter() - begin
        if reference:
            request = replace(frame_request(drawing.size, surface, scene), quality=REFERENCE)
            figures["rmse_final"] = _rmse(result, composited(renderer.render(request)))
    return figures


class _Cost:
    """Adds up what stages cost."""

    def __init__(self, renderer: RenderChild) -> None:
        self._renderer = renderer
        self._seconds: dict[str, float] = {}
        self._processor: dict[str, float] = {}

    def of(self, stage: str, run: Callable[[], Result]) -> Result:
        """Run ``stage`` and note its wall and processor seconds."""
        wall, busy = time.perf_counter(), self._busy()
        result = run()
        self._seconds[stage] = time.perf_counter() - wall
        self._processor[stage] = self._busy() - busy
        return result

    def _busy(self) -> float:
        return time.process_time() + processor_seconds(self._renderer.pid or 0)

    def figures(self) -> dict[str, float]:
        """What the frame cost, in all and by stage."""
        renderer = {f"renderer_{name}": spent for name, spent in self._renderer.spent.items()}
        wall = {"final": sum(self._seconds.values())} | self._seconds
        busy = {"final": sum(self._processor.values())} | self._processor | renderer
        return {f"seconds_{name}": value for name, value in wall.items()} | {
            f"processor_{name}": value for name, value in busy.items()
        }


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
