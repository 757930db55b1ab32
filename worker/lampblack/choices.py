"""Choices and defaults that scenes, render settings and the command line share."""

from dataclasses import dataclass
from typing import Literal

QualityName = Literal["low", "medium", "final"]
"""Presets of ``render/quality.py``."""

FileFormat = Literal["png", "exr"]
"""Kinds of files that a lit frame is written to."""

SolverName = Literal["direct", "adam"]
"""How normals become a surface: the exact minimiser, or the paper's gradient descent."""

LayerRole = Literal["character", "line", "background"]
"""What a layer of a project is."""

FrameLayers = Literal["all", "lit"]
"""The layers of a project that its frames show."""

ApartKind = Literal["none", "ora", "png", "pencil2d", "exr"]
"""Kinds of files that a lit frame is taken apart into."""

NormalsAxis = Literal["up", "down"]
"""Where the green channel of a normal map points: up as in OpenGL, or down as in DirectX."""

Engine = Literal["godot", "unity", "unreal"]
"""Game engines whose habits files may follow."""

FrontSide = Literal["left", "right", "joined"]
"""The side of a stroke that is in front, or none: the surface goes on across the stroke."""

LightKind = Literal["lamp", "sun"]
"""A lamp is a disk of light at its place; a sun shines from there on the whole canvas alike."""

Brush = Literal["bump", "dent", "turn", "round", "hollow"]
"""What a stroke does to the surface: raise it, lower it, or turn it to where the stroke goes; or
say that it is round there, or hollow."""

LIGHT_LAYER = "Light"
"""The name of a layer whose paint is light, unless it has the role of a character or a line."""

GlowName = Literal["emission", "painted"]
"""Light that comes from surfaces: from emissive colours, or from light that was painted."""

BodyChoice = Literal["auto", "own", "below", "flat"]
"""The surface of a layer: found by itself, a body of its own, a part of the body below, or flat
on it."""

LookChoice = Literal["scene", "smooth", "cel"]
"""How a flat colour is lit: as the scene is, in smooth gradients, or in tones."""

DeviceKind = Literal["cpu", "cuda", "optix", "hip", "oneapi", "metal"]
"""What traces light: the processor, or a graphics card by one of Cycles' ways to it."""

DeviceChoice = Literal["auto", "cpu", "cuda", "optix", "hip", "oneapi", "metal"]
"""What is to trace light: ``auto`` is a graphics card that was found right, else the processor."""

DEFAULT_GRIDS = 0
"""Grids of tiles whose predicted normals are averaged; 0 predicts the whole character at once."""


@dataclass(frozen=True)
class PipelineOptions:
    """How surfaces are made, whatever the light: ``grids`` of tiles are averaged, and
    ``solver`` inflates the normals."""

    grids: int = DEFAULT_GRIDS
    solver: SolverName = "direct"
