"""Light frames of a shot into files: each distinct drawing once, however often it is held."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .. import __version__
from ..cache import digest
from ..camera import look_through
from ..composite.colour import linear
from ..errors import LampblackError, LampblackWarning, NothingDrawnError, OutputError
from ..normals.card import shipped_weights
from ..pipeline import Pipeline
from ..scene import Canvas, Scene, encode_scene
from ..timeline import scene_at
from .exr import save_exr
from .layers import Layers, make_layers
from .order import OpenOrder
from .png import save_png
from .shot import Cel, ShotFrame, by_drawing
from .surroundings import Surroundings

Floats = NDArray[np.float32]
Lit = NDArray[np.uint8] | Layers


@dataclass
class Outcome:
    """What became of the frames.

    Attributes:
        done: written, or there already. kept: those that were there.
        unlit: passed through, since nothing is drawn. failed: with the error of each.
    """

    done: list[ShotFrame] = field(default_factory=list)
    kept: list[ShotFrame] = field(default_factory=list)
    unlit: list[ShotFrame] = field(default_factory=list)
    failed: list[tuple[ShotFrame, LampblackError]] = field(default_factory=list)


Listener = Callable[[ShotFrame, LampblackError | None], None]
"""Told of each frame that is done, or failed with an error."""


def light_frames(
    order: OpenOrder,
    pipeline: Pipeline,
    frames: Sequence[ShotFrame] | None = None,
    listener: Listener = lambda frame, error: None,
) -> Outcome:
    """Light ``frames`` (None: all of the order) into their files.

    A frame whose file was made from the same drawing, surroundings and scene is left alone, so
    a job that was stopped goes on where it was. A frame that fails is told and passed over;
    when nothing can be written, the rest fails too.
    """
    job = _Job(order, pipeline)
    wanted = order.frames if frames is None else frames
    for group in by_drawing(wanted):
        held = _Held(job)
        for frame in group:
            error = None
            try:
                if job.full is not None:
                    raise job.full
                held.light(frame)
                job.outcome.done.append(frame)
            except LampblackError as fault:
                error = fault
                job.outcome.failed.append((frame, error))
                if isinstance(error, OutputError):
                    job.full = error
            listener(frame, error)
    return job.outcome


@dataclass
class _Job:
    order: OpenOrder
    pipeline: Pipeline
    outcome: Outcome = field(default_factory=Outcome)
    full: OutputError | None = None
    canvas: Canvas | None = None
    made_by: str = field(init=False)
    surroundings: Surroundings = field(init=False)

    def __post_init__(self) -> None:
        self.made_by = digest(__version__, self.order.options, _weights())
        self.surroundings = Surroundings(self.order.shot, self.pipeline)


@dataclass
class _Held:
    """One drawing, and what has been made of it for the frames that hold it."""

    job: _Job
    _cel: Cel | None = None
    _lit: tuple[Scene, Lit] | None = None

    def light(self, frame: ShotFrame) -> None:
        order = self.job.order
        canvas = order.shot.canvas
        if canvas is None:
            height, width = self._pixels(frame).shape[:2]
            canvas = Canvas(width, height)
        scene = order.staging.scene(canvas)
        self._check_size(frame, canvas, scene)
        scene = scene_at(scene, self._time(frame))
        names = frame.drawing, self.job.surroundings.names(frame), frame.setting
        made_from = (self.job.made_by, order.targets.kind, *names)
        stamp = digest(*made_from, canvas, encode_scene(scene))
        if not order.again and order.targets.holds(frame, stamp):
            self.job.outcome.kept.append(frame)
            return
        self._write(frame, self._made(frame, scene), stamp)

    def _made(self, frame: ShotFrame, scene: Scene) -> Lit:
        """The cel, lit; passed through if nothing is drawn on it."""
        pixels = self._pixels(frame)
        size = pixels.shape[1], pixels.shape[0]
        placed = self.job.order.shot.place(scene, size)
        if self._lit is not None and self._lit[0] == placed:
            return self._lit[1]
        try:
            lit = self._render(frame, placed)
        except NothingDrawnError as error:
            if self.job.order.single:
                raise
            warnings.warn(
                f"{frame.name}: {error.what} Passed through unlit.", LampblackWarning, stacklevel=2
            )
            self.job.outcome.unlit.append(frame)
            return pixels
        self._lit = placed, lit
        return lit

    def _render(self, frame: ShotFrame, scene: Scene) -> Lit:
        pipeline = self.job.pipeline
        drawing = self.job.surroundings.drawing(frame)
        beside = self.job.surroundings.beside(frame)
        if self.job.order.targets.kind == "png":
            return pipeline.render(drawing, scene, beside)
        passes = pipeline.light(drawing, scene, beside)
        normals, height = (
            make(drawing, beside=beside) for make in (pipeline.normals, pipeline.height)
        )
        return make_layers(drawing, scene, passes, normals, height)

    def _write(self, frame: ShotFrame, lit: Lit, stamp: str) -> None:
        shot, target = self.job.order.shot, self.job.order.targets.path(frame)
        if self.job.order.targets.kind == "exr":
            save_exr(target, self._exr_layers(frame, lit), stamp)
        else:
            assert not isinstance(lit, Layers)
            save_png(target, shot.finish(frame, lit), stamp)

    def _exr_layers(self, frame: ShotFrame, lit: Lit) -> dict[str, Floats]:
        """The layers as the frame's camera sees them; of a blank frame, the picture alone."""
        shot = self.job.order.shot
        if not isinstance(lit, Layers):
            return {"": _scene_linear(shot.finish(frame, (lit / np.float32(255))))}
        camera = shot.camera(frame)
        size = lit.lit.shape[1], lit.lit.shape[0]
        if shot.canvas is not None:
            size = shot.canvas.width, shot.canvas.height
        a, b, _, d, e, _ = camera
        scale = np.float32(math.sqrt(abs(a * e - b * d)))
        # Directions turn with the camera; normals count y upwards, pixels downwards.
        turn = np.array([[a, -b, 0], [-d, e, 0], [0, 0, scale]], np.float32) / scale
        seen = {
            **lit.colour,
            "shadow": 1 - lit.shadow,  # past the cel's edges there is none
            "ink": lit.ink,
            "normal": lit.normal @ turn.T,
            "depth": lit.depth * scale,
        }
        layers = {name: look_through(layer, camera, size) for name, layer in seen.items()}
        layers["shadow"] = 1 - layers["shadow"]
        return {"": _scene_linear(shot.finish(frame, lit.lit)), **layers}

    def _cel_of(self, frame: ShotFrame) -> Cel:
        if self._cel is None:
            self._cel = self.job.order.shot.cel(frame)
        return self._cel

    def _pixels(self, frame: ShotFrame) -> NDArray[np.uint8]:
        return self._cel_of(frame).pixels

    def _time(self, frame: ShotFrame) -> int:
        """The frame's number; of one that has none, its place in the order."""
        if frame.number is not None:
            return frame.number
        return self.job.order.frames.index(frame) + 1

    def _check_size(self, frame: ShotFrame, canvas: Canvas, scene: Scene) -> None:
        if self.job.canvas is None:
            self.job.canvas = scene.canvas
        expected = self.job.canvas
        if (canvas.width, canvas.height) != (expected.width, expected.height):
            warnings.warn(
                f"{frame.name} is {canvas.width} x {canvas.height} pixels, not {expected.width} x "
                f"{expected.height} like the scene or the first frame.",
                LampblackWarning,
                stacklevel=2,
            )
            if self.job.order.shot.canvas is not None:
                self.job.canvas = canvas  # once: a project has one size


def _scene_linear(picture: Floats) -> Floats:
    """(H, W, 4) sRGB, straight, to scene-linear, premultiplied."""
    light = linear(picture[..., :3]) * picture[..., 3:]
    whole: Floats = np.concatenate([light, picture[..., 3:]], axis=2)
    return whole


def _weights() -> list[str]:
    """Names for the networks as they are installed: another network makes other pictures."""
    folder: Path = shipped_weights().parent
    return [digest(path.name, path.read_bytes()) for path in sorted(folder.iterdir())]
