"""An order: all that a render is told, as one value that goes to other machines as JSON."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec

from ..drawing import find_frames, load_picture, parse_frames, select_frames
from ..errors import LampblackError
from ..normals.temporal.steady import REACH
from ..pipeline import PipelineOptions, SolverName
from ..project import is_project, read_project
from ..project.shot import ProjectShot
from ..project.stack import Role, roles_of
from ..scene import Scene
from ..shot import Shot, ShotFrame
from .pictures import PictureShot
from .staging import QualityLevel, Staging, read_scene
from .targets import Kind, Targets

SIDECAR_SUFFIX = ".lampblack.json"


class Order(msgspec.Struct, frozen=True, kw_only=True):
    """What ``lampblack render`` is told.

    Attributes:
        inputs: pictures, folders and patterns, or one project.
        output: a folder, or a pattern of file names.
        scene: a file; of a project, its sidecar if there is one.
        frames: a list such as ``1-20x2,25``; None is all.
        roles: of a project's layers, by name; over those in the scene.
        camera: of a project; None is the first.
        steady: normals follow those of the drawings beside each.
        again: make also what is there already and up to date.
    """

    inputs: tuple[str, ...]
    output: str
    scene: str | None = None
    lights: tuple[str, ...] = ()
    floor: float | None = None
    quality: QualityLevel | None = None
    frames: str | None = None
    format: Kind | None = None
    mask: str | None = None
    ink: str | None = None
    grids: int | None = None
    solver: SolverName = "direct"
    roles: dict[str, Role] = {}
    camera: str | None = None
    steady: bool = True
    again: bool = False

    def absolute(self) -> Order:
        """The same order from any folder."""
        named = {name: getattr(self, name) for name in ("output", "scene", "mask", "ink")}
        found = {
            name: str(Path(path).absolute()) for name, path in named.items() if path is not None
        }
        inputs = tuple(str(Path(path).absolute()) for path in self.inputs)
        return msgspec.structs.replace(self, inputs=inputs, **found)

    def arguments(self) -> list[str]:
        """The same order on the command line, after ``lampblack render``."""
        options: dict[str, object] = {
            "--scene": self.scene, "--light": self.lights, "--floor": self.floor,
            "--quality": self.quality, "--frames": self.frames, "--format": self.format,
            "--mask": self.mask, "--ink": self.ink, "--grids": self.grids,
            "--solver": self.solver, "--camera": self.camera,
        }  # fmt: skip
        words = [*self.inputs, "-o", self.output]
        for option, value in options.items():
            for one in value if isinstance(value, tuple) else (value,):
                # One word, so that a value may begin with a dash.
                words += [f"{option}={one}"] if one is not None else []
        words += [f"--{role}={name}" for name, role in self.roles.items()]
        words += [] if self.steady else ["--no-steady"]
        return words + (["--again"] if self.again else [])


@dataclass(frozen=True)
class OpenShot:
    """What an order is made from.

    Attributes:
        frames: those that it names, of the shot's.
        staging: how they are lit.
        sources: the files that are read.
        single: the shot is a single drawing, not one of many.
        reach: drawings to either side of each that its normals follow.
    """

    shot: Shot
    frames: list[ShotFrame]
    staging: Staging
    sources: list[Path]
    single: bool
    reach: int


@dataclass(frozen=True)
class OpenOrder(OpenShot):
    """An order whose files were found and found sound."""

    targets: Targets
    options: PipelineOptions
    again: bool


def open_order(order: Order) -> OpenOrder:
    """Read what ``order`` names, and refuse, before any work, what cannot be done.

    Raises:
        LampblackError: something is missing, mistyped, or would be overwritten.
    """
    targets = Targets(order.output, order.format)
    opened = open_shot(order)
    targets.prepare(opened.frames, opened.sources)
    options = PipelineOptions(solver=order.solver)
    if order.grids is not None:
        options = PipelineOptions(order.grids, order.solver)
    return OpenOrder(**vars(opened), targets=targets, options=options, again=order.again)


def open_shot(order: Order) -> OpenShot:
    """Read what ``order`` names, wherever it is to go.

    Raises:
        LampblackError: something is missing or mistyped.
    """
    read = None if order.scene is None else read_scene(Path(order.scene))
    shot: Shot
    if any(is_project(path) for path in order.inputs):
        read = read or _sidecar(order.inputs[0])
        shot = _project_shot(order, read)
        sources = [Path(order.inputs[0])]
        single = False  # a frame of a project may well be blank
    else:
        found = find_frames(order.inputs)
        single = len(found) == 1
        mask = None if order.mask is None else load_picture(order.mask)
        ink = None if order.ink is None else load_picture(order.ink)
        shot = PictureShot(found, mask, ink)
        sources = [frame.path for frame in found]
    frames = _chosen(shot.frames, order.frames)
    staging = Staging(read, order.lights, order.floor, order.quality)
    return OpenShot(shot, frames, staging, sources, single, REACH if order.steady else 0)


def sidecar_of(project: str | Path) -> Path:
    """Where the drawing tool keeps a project's scene."""
    return Path(f"{project}{SIDECAR_SUFFIX}")


def _sidecar(project: str) -> Scene | None:
    path = sidecar_of(project)
    return read_scene(path) if path.exists() else None


def _project_shot(order: Order, scene: Scene | None) -> ProjectShot:
    if len(order.inputs) > 1:
        raise LampblackError(
            "A project is rendered on its own.", "Name one project, or pictures only."
        )
    if order.mask is not None or order.ink is not None:
        raise LampblackError(
            "In a project, layers say what is figure and what is line.",
            "Leave out --mask and --ink, or name a layer: --line LAYER.",
        )
    project, archive = read_project(order.inputs[0])
    roles = {**(roles_of(scene) if scene is not None else {}), **order.roles}
    return ProjectShot(project, archive, roles, order.camera)


def _chosen(frames: Sequence[ShotFrame], text: str | None) -> list[ShotFrame]:
    return list(frames) if text is None else select_frames(frames, parse_frames(text))
