"""Render settings: all that a render is asked for, as one value that travels as JSON."""

from __future__ import annotations

from pathlib import Path

import msgspec

from ..choices import DEFAULT_GRIDS, FileFormat, LayerRole, QualityName, SolverName


class RenderSettings(msgspec.Struct, frozen=True, kw_only=True):
    """What ``lampblack render`` is asked for.

    Attributes:
        inputs: pictures, folders and patterns, or one project.
        output: a folder, or a pattern of file names.
        scene: a file; of a project, its sidecar if there is one.
        lights: ``X,Y,Z`` each, canvas pixels, instead of the scene's.
        floor: canvas line of a floor, instead of the scene's.
        quality: a preset, instead of the scene's.
        frames: a list such as ``1-20x2,25``; None is all.
        format: of the files; None goes by ``output``, else PNG.
        mask, ink: pictures; see ``decompose_drawing``.
        grids: see ``PipelineOptions``.
        solver: how normals become a surface.
        roles: of a project's layers, by name; over those in the scene.
        camera: a project's layer; None is the first camera.
        steady: normals are smoothed over neighbouring drawings.
        again: render also frames whose files are up to date.
    """

    inputs: tuple[str, ...]
    output: str
    scene: str | None = None
    lights: tuple[str, ...] = ()
    floor: float | None = None
    quality: QualityName | None = None
    frames: str | None = None
    format: FileFormat | None = None
    mask: str | None = None
    ink: str | None = None
    grids: int = DEFAULT_GRIDS
    solver: SolverName = "direct"
    roles: dict[str, LayerRole] = {}
    camera: str | None = None
    steady: bool = True
    again: bool = False

    def absolute(self) -> RenderSettings:
        """The same settings from any folder."""
        named = {name: getattr(self, name) for name in ("output", "scene", "mask", "ink")}
        found = {
            name: str(Path(path).absolute()) for name, path in named.items() if path is not None
        }
        inputs = tuple(str(Path(path).absolute()) for path in self.inputs)
        return msgspec.structs.replace(self, inputs=inputs, **found)

    def arguments(self) -> list[str]:
        """The same settings on the command line, after ``lampblack render``."""
        words = [*self.inputs, "-o", self.output]
        for name in self.__struct_fields__[2:]:
            value = getattr(self, name)
            option = {"lights": "--light"}.get(name, f"--{name}")
            # One word each, so that a value may begin with a dash.
            if isinstance(value, dict):
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
