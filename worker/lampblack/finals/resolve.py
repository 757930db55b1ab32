"""From render settings to the files, frames and scene that they name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..choices import PipelineOptions
from ..drawing import find_frames, load_picture, parse_frames, select_frames
from ..errors import LampblackError
from ..normals.temporal.neighbours import REACH
from ..project import is_project, read_project
from ..project.shot import ProjectShot
from ..project.stack import roles_of
from ..scene import Scene
from ..shot import Shot, ShotFrame
from .pictures import PictureShot
from .scene_overrides import SceneOverrides, read_scene
from .settings import RenderSettings
from .targets import Targets

SIDECAR_SUFFIX = ".lampblack.json"


@dataclass(frozen=True)
class ResolvedShot:
    """The shot that render settings name, read and found sound.

    Attributes:
        frames: those that the settings name, of the shot's.
        overrides: the scene file, and what replaces parts of it.
        sources: the files that are read.
        single: the shot is a single drawing, not one of many.
        reach: neighbours on either side that normals are smoothed over.
    """

    shot: Shot
    frames: list[ShotFrame]
    overrides: SceneOverrides
    sources: list[Path]
    single: bool
    reach: int


@dataclass(frozen=True)
class ResolvedJob(ResolvedShot):
    """A resolved shot, and where and how its frames are written."""

    targets: Targets
    options: PipelineOptions
    again: bool


def resolve_job(settings: RenderSettings) -> ResolvedJob:
    """Read what ``settings`` name, and refuse, before any work, what cannot be done.

    Raises:
        LampblackError: something is missing, mistyped, or would be overwritten.
    """
    targets = Targets(settings.output, settings.format)
    resolved = resolve_shot(settings)
    targets.prepare(resolved.frames, resolved.sources)
    options = PipelineOptions(settings.grids, settings.solver)
    return ResolvedJob(**vars(resolved), targets=targets, options=options, again=settings.again)


def resolve_shot(settings: RenderSettings) -> ResolvedShot:
    """Read what ``settings`` name, wherever it is to go.

    Raises:
        LampblackError: something is missing or mistyped.
    """
    scene = None if settings.scene is None else read_scene(Path(settings.scene))
    shot: Shot
    if any(is_project(path) for path in settings.inputs):
        scene = scene or _sidecar(settings.inputs[0])
        shot = _project_shot(settings, scene)
        sources = [Path(settings.inputs[0])]
        single = False  # a frame of a project may well be blank
    else:
        found = find_frames(settings.inputs)
        single = len(found) == 1
        mask = None if settings.mask is None else load_picture(settings.mask)
        ink = None if settings.ink is None else load_picture(settings.ink)
        shot = PictureShot(found, mask, ink)
        sources = [frame.path for frame in found]
    frames = _chosen(shot.frames, settings.frames)
    overrides = SceneOverrides(scene, settings.lights, settings.floor, settings.quality)
    return ResolvedShot(shot, frames, overrides, sources, single, REACH if settings.steady else 0)


def _sidecar(project: str) -> Scene | None:
    """The scene that the drawing tool keeps beside ``project``."""
    path = Path(f"{project}{SIDECAR_SUFFIX}")
    return read_scene(path) if path.exists() else None


def _project_shot(settings: RenderSettings, scene: Scene | None) -> ProjectShot:
    if len(settings.inputs) > 1:
        raise LampblackError(
            "A project is rendered on its own.", "Name one project, or pictures only."
        )
    if settings.mask is not None or settings.ink is not None:
        raise LampblackError(
            "In a project, layers say what is character and what is line.",
            "Leave out --mask and --ink, or name a layer: --line LAYER.",
        )
    project, archive = read_project(settings.inputs[0])
    roles = {**(roles_of(scene) if scene is not None else {}), **settings.roles}
    return ProjectShot(project, archive, roles, settings.camera)


def _chosen(frames: Sequence[ShotFrame], text: str | None) -> list[ShotFrame]:
    return list(frames) if text is None else select_frames(frames, parse_frames(text))
