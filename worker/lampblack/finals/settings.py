"""Render settings: all that a render is asked for, as one value that travels as JSON."""

from __future__ import annotations

from pathlib import Path

import msgspec

from ..choices import FileFormat, LayerRole, QualityName, SolverName


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
        mask, ink: pictures; see ``take_apart``.
        grids: see ``PipelineOptions``; None is its default.
        solver: how normals become a surface.
        roles: of a project's layers, by name; over those in the scene.
        camera: a project's layer; None is the first camera.
        steady: normals follow those of the drawings beside each.
        again: make also what is there already and up to date.
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
    grids: int | None = None
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
