"""How the cost of a shot grows: with its frames, its drawings, their size, and the lights; and that
its memory does not grow."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from math import cos, pi, sin
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..atomic import atomic_file
from ..cache import ArrayCache
from ..choices import QualityName
from ..errors import LampblackError
from ..finals.render_shot import RenderListener, render_shot
from ..finals.resolve import ResolvedJob, resolve_job
from ..finals.settings import RenderSettings
from ..pipeline import Pipeline
from ..render.client import RenderChild
from ..scene import Scene, default_light, default_scene, encode_scene
from ..service.memory import resident_bytes
from ..shot import ShotFrame
from .memory import processor_seconds

STEPS: Mapping[str, Sequence[int]] = {
    "held_frames": (1, 8, 64),
    "drawings": (1, 2, 4, 8, 16),
    "pixels": (256, 512, 1024, 2048),
    "lights": (1, 2, 4, 8),
}
"""What grows, and its sizes: frames that hold one drawing, distinct drawings, the side of the
canvas, lights."""
SMALL, USUAL = 256, 512
"""Side of the canvas where frames grow, and where lights do."""
MANY = 500
"""Distinct drawings over which memory is watched, and how often."""
EVERY = 20


@dataclass(frozen=True)
class _Shot:
    """A shot of ``frames`` frames; ``drawings`` of them are distinct, on a square canvas."""

    frames: int = 1
    drawings: int = 1
    side: int = SMALL
    lights: int = 1
    quality: QualityName = "final"

    def scene(self) -> Scene:
        """Lights on a circle, all of them as strong as one."""
        middle, around = self.side / 2, 0.4 * self.side
        turns = [2 * pi * number / self.lights for number in range(self.lights)]
        places = [(middle + around * sin(t), middle - around * cos(t)) for t in turns]
        scene = default_scene(self.side, self.side)
        lamps = (default_light(scene.canvas, x, y) for x, y in places)
        return replace(
            scene, lights=tuple(replace(lamp, power=lamp.power / self.lights) for lamp in lamps)
        )


def bench_scale(
    picture: NDArray[np.uint8], progress: Callable[[float], None] = lambda share: None
) -> dict[str, float]:
    """Processor seconds of shots at final quality, nothing cached, network and renderer loaded.
    They tell growth better than wall seconds, which other programs change. And the memory in use
    while a long shot of small drawings is lit at low quality.

    Args:
        picture: (H, W, 4) uint8, the drawing; others are made from it by turning it.

    Returns:
        ``WHAT_N``: the seconds where ``WHAT`` of ``STEPS`` is N. ``WHAT_exponent``: the power of N
        with which they grow, the slope between the last two steps on logarithmic axes.
        ``memory_N``: MiB of all processes after N distinct drawings.
    """
    shots = {
        "held_frames": lambda n: _Shot(frames=n),
        "drawings": lambda n: _Shot(frames=n, drawings=n),
        "pixels": lambda n: _Shot(side=n),
        "lights": lambda n: _Shot(side=USUAL, lights=n),
    }
    drawing = Image.fromarray(picture)
    figures: dict[str, float] = {}
    total, done = sum(len(steps) for steps in STEPS.values()) + MANY / EVERY, 0
    for what, steps in STEPS.items():
        spent = []
        for step in steps:
            spent.append(_seconds(drawing, shots[what](step)))
            figures[f"{what}_{step}"] = spent[-1]
            done += 1
            progress(done / total)
        growth = np.log(spent[-1] / spent[-2]) / np.log(steps[-1] / steps[-2])
        figures[f"{what}_exponent"] = float(growth)
    many = _Shot(MANY, MANY, SMALL // 2, quality="low")
    return figures | _memory(drawing, many, lambda n: progress((done + n / EVERY) / total))


def _seconds(drawing: Image.Image, shot: _Shot) -> float:
    with _prepared(drawing, shot) as (job, pipeline, child):
        before = time.process_time() + processor_seconds(child.pid or 0)
        _light(job, pipeline)
        return time.process_time() + processor_seconds(child.pid or 0) - before


def _memory(drawing: Image.Image, shot: _Shot, progress: Callable[[int], None]) -> dict[str, float]:
    figures: dict[str, float] = {}

    class Watch(RenderListener):
        lit = 0

        def on_frame(self, frame: ShotFrame, error: LampblackError | None, *, kept: bool) -> None:
            self.lit += 1
            if self.lit % EVERY == 0:
                figures[f"memory_{self.lit}"] = resident_bytes([child.pid]) / 2**20
                progress(self.lit)

    with _prepared(drawing, shot) as (job, pipeline, child):
        _light(job, pipeline, Watch())
    return figures


def _light(job: ResolvedJob, pipeline: Pipeline, listener: RenderListener | None = None) -> None:
    if render_shot(job, pipeline, listener=listener).failed:
        raise LampblackError("A frame of the benchmark failed.", "Try: lampblack doctor")


@contextmanager
def _prepared(
    drawing: Image.Image, shot: _Shot
) -> Iterator[tuple[ResolvedJob, Pipeline, RenderChild]]:
    """The shot as files, with nothing cached, and network and renderer loaded."""
    with TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "drawn").mkdir()
        square = drawing.resize((shot.side, shot.side), Image.Resampling.LANCZOS)
        turn = min(3, 350 / shot.drawings)
        for frame in range(shot.frames):
            turned = square.rotate(turn * (frame % shot.drawings), Image.Resampling.BICUBIC)
            turned.save(folder / "drawn" / f"{frame:04}.png")
        with atomic_file(folder / "scene.json") as file:
            file.write(encode_scene(shot.scene()))
        job = resolve_job(
            RenderSettings(
                inputs=(str(folder / "drawn"),),
                output=str(folder / "lit"),
                scene=str(folder / "scene.json"),
                quality=shot.quality,
            )
        )
        child = RenderChild()
        with Pipeline(ArrayCache(folder / "cache"), job.options, renderer=child) as pipeline:
            pipeline.warm_up()
            yield job, pipeline, child
