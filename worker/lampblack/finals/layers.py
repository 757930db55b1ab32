"""The layers of a multilayer EXR: the light of each source, and the character's own layers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import get_args

import numpy as np
from numpy.typing import NDArray

from ..camera import look_through
from ..choices import GlowName
from ..colour import linear
from ..composite.float_kernel import composite_unrounded
from ..composite.illumination import Illumination, weigh
from ..composite.reflection import character_light
from ..composite.resample import Band, enlarge
from ..drawing import Drawing
from ..prepared import PreparedDrawing
from ..render.passes import Passes
from ..scene import Scene
from ..shot import Shot, ShotFrame

Floats = NDArray[np.float32]

LEAST_LIGHTS = 4
"""Layers of lights that every file has, so that they do not come and go between scenes."""


@dataclass(frozen=True)
class Layers:
    """The layers of one lit cel, all (H, W, C) float32.

    Attributes:
        lit: (H, W, 4) sRGB in 0..1, straight alpha: the PNG before rounding.
        colour: scene-linear by name, 3 channels each, premultiplied with the character's coverage:
            ``diffuse`` + ``glossy`` = ``light1`` + ... + ``ambient`` is the light on the character
            before highlights are compressed; ``unlit`` are colours shown as drawn; ``albedo``.
        shadow: (H, W, 3), the floor's light with the character divided by that without it; 1 is no
            shadow.
        ink: (H, W, 4), the line, scene-linear, premultiplied.
        normal: (H, W, 3), x right, y up, z to the viewer; 0 outside the character.
        depth: (H, W, 1), height above the paper, canvas pixels, towards the viewer.
    """

    lit: Floats
    colour: dict[str, Floats]
    shadow: Floats
    ink: Floats
    normal: Floats
    depth: Floats


def make_layers(prepared: PreparedDrawing, scene: Scene, passes: Passes) -> Layers:
    """The layers of a drawing, prepared in full detail with normals, and lit by ``passes``."""
    drawing = prepared.layers
    assert isinstance(drawing, Drawing)
    assert prepared.normals is not None
    columns, rows = drawing.size
    band = Band(columns, rows, 0, rows)
    cover = drawing.coverage[..., None]
    sources = weigh(passes, scene)
    illumination = Illumination.of(passes, scene, prepared.form_for(scene))
    diffuse, glossy, unlit = character_light(drawing, scene, illumination, band)
    colour = {
        "diffuse": cover * diffuse,
        "glossy": cover * glossy,
        "unlit": cover * unlit,
        "albedo": cover * linear(drawing.albedo),
    }
    dark = np.zeros_like(diffuse)
    count = max(LEAST_LIGHTS, len(scene.lights))
    names = [f"light{number}" for number in range(1, count + 1)] + ["ambient"]
    colour.update(dict.fromkeys(names, dark))
    glows = {name: getattr(passes, name) for name in get_args(GlowName)}
    present = dict(
        zip(
            [*names[: len(passes.lights)], "ambient"], (*passes.lights, passes.ambient), strict=True
        )
    )
    present |= {name: source for name, source in glows.items() if source is not None}
    for name, source in present.items():
        own = [one for one in sources if one.light is source]
        if own:
            light = character_light(drawing, scene, Illumination.sum_of(own, passes.ambient), band)
            colour[name] = cover * sum(light[:2])
    line = drawing.ink[..., None] * cover
    ratio = illumination.floor_ratio
    return Layers(
        lit=composite_unrounded(drawing, illumination, scene, prepared.edges_for(scene)),
        colour=colour,
        shadow=np.ones_like(diffuse) if ratio is None else enlarge(ratio, band),
        ink=np.concatenate([linear(drawing.ink_colour) * line, line], axis=2),
        normal=prepared.normals.astype(np.float32, copy=False),
        depth=_spread(prepared.height, (rows, columns)) * drawing.mask[..., None],
    )


def seen_layers(shot: Shot, frame: ShotFrame, lit: Layers | NDArray[np.uint8]) -> dict[str, Floats]:
    """The layers of the EXR of ``frame``, by name, as its camera sees them. A blank cel, (H, W, 4)
    sRGB, has only the picture."""
    if not isinstance(lit, Layers):
        return {"": scene_linear(shot.finish(frame, lit.astype(np.float32) / 255.0))}
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
    return {"": scene_linear(shot.finish(frame, lit.lit)), **layers}


def _spread(height: Floats, shape: tuple[int, int]) -> Floats:
    """A height that was solved at a fraction of the size, resized to full size, (H, W, 1)."""
    step = -(-shape[0] // height.shape[0])
    whole = height.repeat(step, axis=0).repeat(step, axis=1)[: shape[0], : shape[1]]
    rows, columns = shape[0] - whole.shape[0], shape[1] - whole.shape[1]
    return np.pad(whole, ((0, rows), (0, columns)), "edge")[..., None]


def scene_linear(picture: Floats) -> Floats:
    """(H, W, 4) sRGB, straight, to scene-linear, premultiplied."""
    light = linear(picture[..., :3]) * picture[..., 3:]
    whole: Floats = np.concatenate([light, picture[..., 3:]], axis=2)
    return whole
