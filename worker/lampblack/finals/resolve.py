"""Resolving render settings: from names to a shot, its frames and a scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..choices import DeviceChoice, PipelineOptions
from ..drawing import Frame, find_frames, load_picture, parse_frames, select_frames
from ..drawing.numbering import is_pattern
from ..errors import LampblackError
from ..looks import find_style
from ..normals.temporal.neighbours import REACH
from ..project import is_project, read_project
from ..project.read import PENCIL2D
from ..project.shot import ProjectShot
from ..project.stack import roles_of
from ..rigs import find_rig
from ..scene import Scene
from ..shot import Picture, Shot, ShotFrame
from .layered_sequence import LayeredSequence
from .pictures import PictureShot
from .scene_overrides import SceneOverrides, read_depth_hints, read_scene
from .settings import RenderSettings
from .sheet import SheetShot, cells_of
from .targets import Targets

SIDECAR_SUFFIX = ".lampblack.json"


@dataclass(frozen=True)
class ResolvedShot:
    """The shot of render settings, read and checked.

    Attributes:
        frames: the selected frames of the shot.
        overrides: the scene file, and the settings that replace parts of it.
        sources: the input files.
        single: whether the input is one single drawing.
        reach: number of neighbours on either side for the temporal filter.
    """

    shot: Shot
    frames: list[ShotFrame]
    overrides: SceneOverrides
    sources: list[Path]
    single: bool
    reach: int


@dataclass(frozen=True)
class ResolvedJob(ResolvedShot):
    """A resolved shot, with its target files and pipeline options."""

    targets: Targets
    options: PipelineOptions
    device: DeviceChoice
    again: bool


def resolve_job(settings: RenderSettings, scene: Scene | None = None) -> ResolvedJob:
    """Resolve ``settings``. Impossible jobs are refused before any work.

    Args:
        scene: in place of a scene file.

    Raises:
        LampblackError: an input is missing or malformed, or a source would be overwritten.
    """
    targets = Targets(settings.output, settings.format, apart=settings.apart)
    resolved = resolve_shot(settings, scene)
    targets.prepare(resolved.frames, resolved.sources)
    options = PipelineOptions(settings.grids, settings.solver)
    return ResolvedJob(
        **vars(resolved),
        targets=targets,
        options=options,
        device=settings.device,
        again=settings.again,
    )


def resolve_shot(settings: RenderSettings, scene: Scene | None = None) -> ResolvedShot:
    """Resolve the inputs of ``settings``, without its output.

    Raises:
        LampblackError: an input is missing or malformed.
    """
    named = scene_file(settings)
    if scene is None and named is not None:
        scene = read_scene(named)
    shot: Shot
    single = False  # a frame of a project may well be blank
    if _is_project(settings.inputs):
        _refuse_options_of_pictures(settings)
        shot = _project_shot(settings, scene)
        sources = [Path(settings.inputs[0])]
    else:
        found = find_frames(settings.inputs)
        sources = [frame.path for frame in found]
        layered = [is_project(path) for path in sources]
        if any(layered):
            _refuse_options_of_pictures(settings)
            if not all(layered):
                raise LampblackError(
                    "Pictures and drawings with layers make no sequence.", "Render them apart."
                )
            shot = LayeredSequence(found, settings.roles, settings.layers)
        else:
            single = len(found) == 1 and settings.sheet is None
            mask = None if settings.mask is None else load_picture(settings.mask)
            ink = None if settings.ink is None else load_picture(settings.ink)
            shot = _picture_shot(settings, found, mask, ink)
    frames = _chosen(shot.frames, settings.frames)
    hints = settings.depth_hints
    overrides = SceneOverrides(
        scene,
        None if settings.rig is None else find_rig(settings.rig),
        None if settings.look is None else find_style(settings.look),
        settings.lights,
        settings.floor,
        settings.quality,
        None if hints is None else read_depth_hints(Path(hints)),
        settings.bodies,
    )
    return ResolvedShot(shot, frames, overrides, sources, single, REACH if settings.steady else 0)


def _picture_shot(
    settings: RenderSettings, found: Sequence[Frame], mask: Picture | None, ink: Picture | None
) -> PictureShot | SheetShot:
    if settings.sheet is None:
        return PictureShot(found, mask, ink)
    cells = cells_of(settings.sheet)
    if len(found) > 1:
        raise LampblackError(
            f"{len(found)} pictures were named, and --sheet cuts one.",
            "Name one sheet, or leave out --sheet.",
        )
    return SheetShot(found[0].path, cells, mask, ink)


def scene_file(settings: RenderSettings) -> Path | None:
    """The scene file that is named, or that of the Pencil2D plugin next to a project.

    Raises:
        LampblackError: a project is named with something else.
    """
    if settings.scene is not None:
        return Path(settings.scene)
    beside = Path(f"{settings.inputs[0]}{SIDECAR_SUFFIX}")
    return beside if _is_project(settings.inputs) and beside.exists() else None


def _is_project(inputs: Sequence[str]) -> bool:
    """Whether ``inputs`` name one project, and no sequence of drawings with layers.

    Raises:
        LampblackError: a project is named with something else.
    """
    if any(Path(path).suffix.lower() in PENCIL2D for path in inputs):
        if len(inputs) > 1:
            raise LampblackError(
                "A project is rendered on its own.", "Name one project, or pictures only."
            )
        return True
    one = Path(inputs[0]) if len(inputs) == 1 else None
    return one is not None and is_project(one) and (one.exists() or not is_pattern(one.name))


def _refuse_options_of_pictures(settings: RenderSettings) -> None:
    if settings.sheet is not None:
        raise LampblackError("A drawing with layers is no sprite sheet.", "Leave out --sheet.")
    if settings.mask is not None or settings.ink is not None:
        raise LampblackError(
            "Where there are layers, they say what is character and what is line.",
            "Leave out --mask and --ink, or name a layer: --line LAYER.",
        )


def _project_shot(settings: RenderSettings, scene: Scene | None) -> ProjectShot:
    project, archive = read_project(settings.inputs[0])
    roles = {**(roles_of(scene) if scene is not None else {}), **settings.roles}
    return ProjectShot(project, archive, roles, settings.camera, settings.layers)


def _chosen(frames: Sequence[ShotFrame], text: str | None) -> list[ShotFrame]:
    return list(frames) if text is None else select_frames(frames, parse_frames(text))
