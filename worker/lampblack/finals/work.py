"""What there is to do for a shot: frames that one lit cel serves, made ready for their light."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .. import __version__
from ..cache import digest
from ..drawing import Drawing
from ..errors import LampblackError, LampblackWarning, NothingDrawnError
from ..normals.card import shipped_weights
from ..pipeline import Pipeline
from ..render import Passes, Surface
from ..scene import Canvas, Scene, encode_scene
from ..shot import Cel, Picture, ShotFrame, by_drawing
from ..timeline import scene_at
from .neighbours import NeighbourLoader
from .resolve import ResolvedJob

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Model:
    """A drawing, ready to be lit; with its steadied normals and height if layers are wanted."""

    drawing: Drawing
    surface: Surface
    normals: Floats | None
    height: Floats | None


@dataclass
class Work:
    """Frames that show one drawing under one light.

    Attributes:
        frames: each with the stamp of what its file is made from.
        scene: in the cel's pixels. pixels: of the cel. Of what is to be lit.
        kept: their files are there and up to date.
        blank: why the cel is passed through unlit. error: why it cannot be.
        model, passes: as far as they are made.
    """

    frames: list[tuple[ShotFrame, str]]
    scene: Scene | None = None
    pixels: Picture | None = None
    kept: bool = False
    blank: str | None = None
    error: LampblackError | None = None
    model: Model | None = None
    passes: Passes | None = None


def plan(
    order: ResolvedJob,
    pipeline: Pipeline,
    frames: Sequence[ShotFrame],
    check: Callable[[], None] = lambda: None,
) -> Generator[Work, None, None]:
    """All there is to do for ``frames``, made ready one by one; ``check`` is called often, and
    what it raises ends it."""
    planner = _Planner(order, pipeline, check)
    for group in by_drawing(frames):
        yield from planner.group(group)


class _Planner:
    def __init__(self, order: ResolvedJob, pipeline: Pipeline, check: Callable[[], None]) -> None:
        self._order = order
        self._pipeline = pipeline
        self._neighbour_loader = NeighbourLoader(order.shot, pipeline, order.reach, check)
        self._made_by = digest(__version__, order.options, _weights())
        self._canvas: Canvas | None = None

    def group(self, frames: Sequence[ShotFrame]) -> Generator[Work, None, None]:
        """The works of frames that share a drawing; those that nothing is done for come first."""
        waiting: list[Work] = []
        cel: Cel | None = None
        shot = self._order.shot
        for frame in frames:
            try:
                if shot.canvas is None:
                    cel = cel or shot.cel(frame)
                canvas = shot.canvas or Canvas(*_size(cel))
                scene = self._scene(frame, canvas)
                stamp = self._stamp(frame, canvas, scene)
                if not self._order.again and self._order.targets.holds(frame, stamp):
                    yield Work([(frame, stamp)], kept=True)
                    continue
                cel = cel or shot.cel(frame)
                placed = shot.place(scene, _size(cel))
            except LampblackError as error:
                yield Work([(frame, "")], error=error)
                continue
            if not waiting or waiting[-1].scene != placed:
                waiting.append(Work([], scene=placed, pixels=cel.pixels))
            waiting[-1].frames.append((frame, stamp))
        if waiting:
            # Keys move lights and floor: the surface is the same throughout.
            self._make_model(first := waiting[0])
            yield from [replace(first, frames=work.frames, scene=work.scene) for work in waiting]

    def _make_model(self, work: Work) -> None:
        frame, _ = work.frames[0]
        assert work.scene is not None
        try:
            drawing = self._neighbour_loader.drawing(frame)
            neighbours = self._neighbour_loader.neighbours(frame)
            surface = self._pipeline.surface(drawing, work.scene, neighbours)
            normals = height = None
            if self._order.targets.kind == "exr":
                normals = self._pipeline.normals(drawing, neighbours=neighbours)
                height = self._pipeline.height(drawing, neighbours=neighbours)
            work.model = Model(drawing, surface, normals, height)
        except NothingDrawnError as error:
            if self._order.single:
                work.error = error
            work.blank = error.what
        except LampblackError as error:
            work.error = error

    def _scene(self, frame: ShotFrame, canvas: Canvas) -> Scene:
        """The scene of ``frame``, in canvas pixels."""
        scene = self._order.overrides.scene(canvas)
        if self._canvas is None:
            self._canvas = scene.canvas
        expected = self._canvas
        if (canvas.width, canvas.height) != (expected.width, expected.height):
            warnings.warn(
                f"{frame.name} is {canvas.width} x {canvas.height} pixels, not {expected.width} x "
                f"{expected.height} like the scene or the first frame.",
                LampblackWarning,
                stacklevel=2,
            )
            if self._order.shot.canvas is not None:
                self._canvas = canvas  # once: a project has one size
        number = frame.number
        # Of a frame without a number, its place in the order.
        return scene_at(scene, self._order.frames.index(frame) + 1 if number is None else number)

    def _stamp(self, frame: ShotFrame, canvas: Canvas, scene: Scene) -> str:
        names = frame.drawing, self._neighbour_loader.names(frame), frame.setting
        made_from = (self._made_by, self._order.targets.kind, *names)
        return digest(*made_from, canvas, encode_scene(scene))


def _size(cel: Cel | None) -> tuple[int, int]:
    assert cel is not None
    return cel.pixels.shape[1], cel.pixels.shape[0]


def _weights() -> list[str]:
    """Names for the networks as they are installed: another network makes other pictures."""
    folder: Path = shipped_weights().parent
    return [digest(path.name, path.read_bytes()) for path in sorted(folder.iterdir())]
