"""Render tasks: frames that show one drawing under one light, prepared for rendering."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..cache import digest, program_digest
from ..choices import DeviceKind
from ..errors import LampblackError, LampblackWarning, NothingDrawnError
from ..normals.card import shipped_weights
from ..pipeline import Pipeline
from ..prepared import PreparedDrawing
from ..render.passes import Passes
from ..render.quality import QUALITIES
from ..render.request import Surface
from ..scene import Canvas, Scene, encode_scene
from ..shot import Cel, Picture, ShotFrame, by_drawing
from ..timeline import is_keyed, scene_at
from ..warning_collector import collect_warnings
from .hint_loader import HintLoader
from .neighbours import NeighbourLoader
from .pin_loader import PinLoader
from .resolve import ResolvedJob

StampedFrame = tuple[ShotFrame, str]
"""A frame, and the stamp of its file: a digest of all inputs."""


@dataclass(frozen=True)
class UpToDate:
    """The file of ``frame`` is complete and has the same inputs; ``device`` traced it."""

    frame: ShotFrame
    device: DeviceKind


@dataclass(frozen=True)
class Failed:
    """The frames cannot be rendered."""

    frames: Sequence[StampedFrame]
    error: LampblackError


@dataclass(frozen=True)
class Blank:
    """The cel is blank: its ``pixels``, (H, W, 4) uint8, are written as drawn."""

    frames: Sequence[StampedFrame]
    pixels: Picture
    reason: NothingDrawnError


@dataclass(frozen=True)
class Ready:
    """Frames that show one drawing under one light.

    Attributes:
        scene: in the cel's pixels.
        surface: the relief of ``prepared`` with the materials of ``scene``.
        mixed: whether lights may be traced as one: nothing but the picture is wanted of them, and
            none of them moves on its own from frame to frame.
        warnings: warnings from preparing the drawing, if warnings are collected.
    """

    frames: Sequence[StampedFrame]
    scene: Scene
    prepared: PreparedDrawing
    surface: Surface
    mixed: bool
    warnings: Sequence[str] = ()


@dataclass(frozen=True)
class Traced:
    """A task with its traced light."""

    task: Ready
    passes: Passes


RenderTask = UpToDate | Failed | Blank | Ready


def plan(
    job: ResolvedJob,
    pipeline: Pipeline,
    frames: Sequence[ShotFrame],
    check: Callable[[], None] = lambda: None,
) -> Generator[RenderTask, None, None]:
    """The tasks of ``frames``, prepared one by one. ``check`` is called often; an exception from it
    ends the plan."""
    planner = _Planner(job, pipeline, check)
    for group in by_drawing(frames):
        yield from planner.group(group)


def stamps(job: ResolvedJob, pipeline: Pipeline) -> Callable[[ShotFrame], str]:
    """What tells the stamp of a frame's files if they are made from what ``job`` has now. It reads
    drawings, and raises a LampblackError for one that cannot be read."""
    return _Planner(job, pipeline, lambda: None).stamp


@dataclass
class _Lighting:
    """Frames of one drawing that share a light: ``scene`` in the cel's pixels, and in those of the
    canvas."""

    scene: Scene
    canvas_scene: Scene
    frames: list[StampedFrame]


class _Planner:
    def __init__(self, job: ResolvedJob, pipeline: Pipeline, check: Callable[[], None]) -> None:
        self._job = job
        self._pipeline = pipeline
        self._check = check
        self._neighbours = NeighbourLoader(
            job.shot, pipeline, job.reach, check, job.overrides.layer_bodies
        )
        self._hints = HintLoader(job.shot, self._neighbours)
        self._pins = PinLoader(job.shot, self._neighbours)
        self._made_by = digest(program_digest(), job.options, _weights())
        self._canvas: Canvas | None = None
        self._keyed = False

    def group(self, frames: Sequence[ShotFrame]) -> Generator[RenderTask, None, None]:
        """The tasks of frames that share a drawing; files that are up to date come first."""
        lightings: list[_Lighting] = []
        cel: Cel | None = None
        shot = self._job.shot
        for frame in frames:
            try:
                if shot.canvas is None:
                    cel = cel or shot.cel(frame)
                canvas = shot.canvas or Canvas(*_size(cel))
                scene = self._scene(frame, canvas)
                stamp = self._stamp(frame, canvas, scene)
                if not self._job.again:
                    device = self._job.targets.holds(frame, stamp, self._job.device)
                    if device is not None:
                        yield UpToDate(frame, device)
                        continue
                cel = cel or shot.cel(frame)
                placed = shot.place(frame, scene, _size(cel))
                placed = self._pins.followed(frame, placed, scene)
            except LampblackError as error:
                yield Failed([(frame, "")], error)
                continue
            if not lightings or lightings[-1].scene != placed:
                lightings.append(_Lighting(placed, scene, []))
            lightings[-1].frames.append((frame, stamp))
        if cel is not None and lightings:
            yield from self._prepare(lightings, cel)

    def stamp(self, frame: ShotFrame) -> str:
        """The stamp of the files of ``frame``."""
        shot = self._job.shot
        canvas = shot.canvas or Canvas(*_size(shot.cel(frame)))
        return self._stamp(frame, canvas, self._scene(frame, canvas))

    def _prepare(self, lightings: Sequence[_Lighting], cel: Cel) -> list[RenderTask]:
        """Tasks for all lightings of a cel. Keys move lights and floor, not the surface."""
        frame, _ = lightings[0].frames[0]
        scene = lightings[0].scene
        all_frames = [stamped for lighting in lightings for stamped in lighting.frames]
        try:
            with collect_warnings() as collected:
                drawing = self._neighbours.drawing(frame)
                prepared = self._pipeline.prepare(
                    drawing,
                    self._neighbours.neighbours(frame),
                    hints=self._hints.hints(frame, drawing, lightings[0].canvas_scene),
                    progress=lambda share: self._check(),
                    with_normals=self._job.targets.kind == "exr",
                )
                surface = prepared.surface(scene, QUALITIES[scene.quality].mesh_stride)
        except NothingDrawnError as error:
            if self._job.single:
                return [Failed(all_frames, error)]
            return [Blank(all_frames, cel.pixels, error)]
        except LampblackError as error:
            return [Failed(all_frames, error)]
        whole = self._job.targets.kind == "png" and self._job.targets.apart == "none"
        mixed = whole and not self._keyed
        first = Ready(lightings[0].frames, scene, prepared, surface, mixed, tuple(collected))
        rest = [
            replace(first, frames=lighting.frames, scene=lighting.scene, warnings=())
            for lighting in lightings[1:]
        ]
        return [first, *rest]

    def _scene(self, frame: ShotFrame, canvas: Canvas) -> Scene:
        """The scene of ``frame``, in canvas pixels."""
        scene = self._job.overrides.scene(canvas)
        self._keyed = is_keyed(scene)
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
            if self._job.shot.canvas is not None:
                self._canvas = canvas  # warn once: a project has one size
        number = frame.number
        # A frame without a number is counted by its position in the job.
        return scene_at(scene, self._job.frames.index(frame) + 1 if number is None else number)

    def _stamp(self, frame: ShotFrame, canvas: Canvas, scene: Scene) -> str:
        names = frame.drawing, self._neighbours.names(frame), frame.setting
        hinted = *self._hints.names(frame, scene), *self._pins.names(scene)
        targets = self._job.targets
        # Only an EXR has its layers in the same file.
        kind = "exr apart" if targets.apart == "exr" else targets.kind
        made_from = (self._made_by, kind, *names, *hinted)
        return digest(*made_from, canvas, encode_scene(scene))


def _size(cel: Cel | None) -> tuple[int, int]:
    assert cel is not None
    return cel.pixels.shape[1], cel.pixels.shape[0]


def _weights() -> list[str]:
    """Digests of the installed networks: another network makes other pictures."""
    folder: Path = shipped_weights().parent
    return [digest(path.name, path.read_bytes()) for path in sorted(folder.iterdir())]
