"""Render settings: everything that determines a render, as one value that can be sent as JSON."""

from __future__ import annotations

from pathlib import Path

import msgspec

from .. import looks
from ..choices import (
    DEFAULT_GRIDS,
    ApartKind,
    BodyChoice,
    DeviceChoice,
    FileFormat,
    FrameLayers,
    LayerRole,
    QualityName,
    SolverName,
)
from ..rigs import preset_name


class RenderSettings(msgspec.Struct, frozen=True, kw_only=True):
    """The settings of ``lampblack render``.

    Attributes:
        inputs: pictures, folders and patterns, or one project.
        output: a folder, or a pattern of file names.
        scene: scene file; None is the file next to a project, or the default scene.
        rig: name or file of a rig, in place of the scene's lights and ambient light.
        look: name or file of a style, in place of the scene's look and rim.
        lights: ``X,Y,Z`` each, in canvas pixels, in place of the scene's lights.
        floor: canvas line of a floor, in place of the scene's floor.
        quality: preset, in place of the scene's.
        depth_hints: file of depth hints, in place of the scene's depth.
        sheet: columns and rows of the one input, ``8x4``: its cells are the frames.
        frames: list such as ``1-20x2,25``; None is all.
        format: file format; None is that of ``output``, or PNG.
        apart: files of the layers that each frame is taken apart into.
        mask, ink: picture files; see ``decompose_drawing``.
        grids: see ``PipelineOptions``.
        solver: method of inflation.
        roles: roles of a project's layers by name, in place of those in the scene.
        bodies: surfaces of layers by name, in place of those in the scene.
        camera: camera layer of a project; None is the first camera.
        layers: layers of a project that the frames show: all, or only the lit ones.
        steady: whether normals pass the temporal filter.
        device: what traces the light. Files from another device are up to date only for ``auto``.
        again: whether frames whose files are up to date are rendered again.
    """

    inputs: tuple[str, ...]
    output: str
    scene: str | None = None
    rig: str | None = None
    look: str | None = None
    lights: tuple[str, ...] = ()
    floor: float | None = None
    quality: QualityName | None = None
    depth_hints: str | None = None
    sheet: str | None = None
    frames: str | None = None
    format: FileFormat | None = None
    apart: ApartKind = "none"
    mask: str | None = None
    ink: str | None = None
    grids: int = DEFAULT_GRIDS
    solver: SolverName = "direct"
    roles: dict[str, LayerRole] = {}
    bodies: dict[str, BodyChoice] = {}
    camera: str | None = None
    layers: FrameLayers = "all"
    steady: bool = True
    device: DeviceChoice = "auto"
    again: bool = False

    def absolute(self) -> RenderSettings:
        """The same settings with absolute paths."""
        named = {
            name: getattr(self, name) for name in ("output", "scene", "depth_hints", "mask", "ink")
        }
        found = {
            name: str(Path(path).absolute()) for name, path in named.items() if path is not None
        }
        if self.rig is not None and preset_name(self.rig) is None:
            found["rig"] = str(Path(self.rig).absolute())
        if self.look is not None and looks.preset_name(self.look) is None:
            found["look"] = str(Path(self.look).absolute())
        inputs = tuple(str(Path(path).absolute()) for path in self.inputs)
        return msgspec.structs.replace(self, inputs=inputs, **found)

    def arguments(self) -> list[str]:
        """The same settings as command-line arguments of ``lampblack render``."""
        words = [*self.inputs, "-o", self.output]
        for name in self.__struct_fields__[2:]:
            value = getattr(self, name)
            option = {"lights": "--light"}.get(name, f"--{name.replace('_', '-')}")
            # One word each, so that a value may begin with a dash.
            if name == "bodies":
                words += [f"--layer-body={layer}={body}" for layer, body in value.items()]
            elif isinstance(value, dict):
                words += [f"--{role}={layer}" for layer, role in value.items()]
            elif isinstance(value, tuple):
                words += [f"{option}={one}" for one in value]
            elif value is False and name == "steady":
                words.append("--no-steady")
            elif value is True and name == "again":
                words.append("--again")
            elif not isinstance(value, bool | None):
                words.append(f"{option}={value}")
        return words
