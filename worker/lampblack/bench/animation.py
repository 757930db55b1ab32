"""A whole shot at final quality: the time per frame, and the share outside the renderer."""

from __future__ import annotations

import time
from pathlib import Path
from tempfile import TemporaryDirectory

from ..cache import ArrayCache
from ..finals.render_shot import render_shot
from ..finals.resolve import resolve_job
from ..finals.settings import RenderSettings
from ..pipeline import Pipeline
from ..render.client import RenderChild
from ..render.passes import Passes
from ..render.request import RenderRequest
from ..shot import by_drawing
from .memory import peak_gib, processor_seconds


class _TimedChild(RenderChild):
    """Sums the time spent waiting for the renderer."""

    seconds = 0.0

    def render(self, request: RenderRequest) -> Passes:
        begin = time.perf_counter()
        try:
            return super().render(request)
        finally:
            self.seconds += time.perf_counter() - begin


def bench_animation(source: Path, scene: Path | None) -> dict[str, float]:
    """Wall seconds of a shot with empty caches, and per distinct drawing; the share of that time in
    which the renderer was idle; the share of processor time outside the renderer, which is more
    reliable on a busy machine; and an upper bound on the peak memory of all processes.

    Args:
        source: a project or a folder. scene: its quality is ignored.
    """
    with TemporaryDirectory() as folder:
        settings = RenderSettings(
            inputs=(str(source),),
            output=f"{folder}/lit",
            scene=None if scene is None else str(scene),
            quality="final",
        )
        opened = resolve_job(settings)
        drawings = len(by_drawing(opened.frames))
        child = _TimedChild()
        with Pipeline(ArrayCache(Path(folder)), opened.options, renderer=child) as pipeline:
            pipeline.warm_up()
            before = time.process_time(), processor_seconds(child.pid or 0)
            begin = time.perf_counter()
            outcome = render_shot(opened, pipeline)
            seconds = time.perf_counter() - begin
            rendering = processor_seconds(child.pid or 0) - before[1]
            joining = time.process_time() - before[0]
    return {
        "frames": len(opened.frames),
        "frames_failed": len(outcome.failed),
        "distinct_drawings": drawings,
        "seconds": round(seconds, 2),
        "seconds_a_drawing": round(seconds / drawings, 2),
        "share_outside_renderer": round(1 - child.seconds / seconds, 3),
        "processor_share_outside_renderer": round(joining / (joining + rendering), 3),
        "peak_memory_gib": peak_gib(),
    }
