"""The layers of a multilayer final: what each light does, and what the figure is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..composite.colour import linear
from ..composite.composite import composite_unrounded, figure_light, weigh
from ..composite.resample import Band
from ..composite.shadow import floor_ratio
from ..drawing import Drawing
from ..render import Passes
from ..scene import MAX_LIGHTS, Scene

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class Layers:
    """One lit cel in layers, all (H, W, C) float32.

    Attributes:
        lit: (H, W, 4) sRGB in 0..1, straight alpha: what the PNG is rounded from.
        colour: scene-linear by name, 3 channels each, premultiplied with the figure's coverage:
            ``diffuse`` + ``glossy`` = ``light1`` + ... + ``ambient`` is the light on the figure
            before it is bent below white; ``unlit`` is what was left as drawn; ``albedo``.
        shadow: (H, W, 3), the floor's light with the figure over that without; 1 is none.
        ink: (H, W, 4), the line, scene-linear, premultiplied.
        normal: (H, W, 3), x right, y up, z to the viewer; 0 outside the figure.
        depth: (H, W, 1), height above the paper, canvas pixels, towards the viewer.
    """

    lit: Floats
    colour: dict[str, Floats]
    shadow: Floats
    ink: Floats
    normal: Floats
    depth: Floats


def make_layers(
    drawing: Drawing, scene: Scene, passes: Passes, normals: Floats, height: Floats
) -> Layers:
    """The layers of a drawing lit by ``passes``.

    Args:
        normals: (H, W, 3). height: (h, w), the drawing's size, or a whole fraction of it.
    """
    columns, rows = drawing.size
    band = Band(columns, rows, 0, rows)
    cover = drawing.coverage[..., None]
    sources = weigh(passes, scene)
    diffuse, glossy, unlit = figure_light(drawing, scene, sources, band)
    colour = {
        "diffuse": cover * diffuse,
        "glossy": cover * glossy,
        "unlit": cover * unlit,
        "albedo": cover * linear(drawing.albedo),
    }
    dark = np.zeros_like(diffuse)
    names = [f"light{number}" for number in range(1, MAX_LIGHTS + 1)] + ["ambient"]
    colour.update(dict.fromkeys(names, dark))
    present = [*names[: len(passes.lights)], "ambient"]
    for name, source in zip(present, (*passes.lights, passes.ambient), strict=True):
        own = [(weight, light) for weight, light in sources if light is source]
        if own:
            colour[name] = cover * sum(figure_light(drawing, scene, own, band)[:2])
    line = drawing.ink[..., None] * cover
    return Layers(
        lit=composite_unrounded(drawing, passes, scene),
        colour=colour,
        shadow=floor_ratio(sources, band),
        ink=np.concatenate([linear(drawing.ink_colour) * line, line], axis=2),
        normal=normals,
        depth=_spread(height, (rows, columns)) * drawing.mask[..., None],
    )


def _spread(height: Floats, shape: tuple[int, int]) -> Floats:
    """A height solved at a fraction of the size, at full size, (H, W, 1)."""
    step = -(-shape[0] // height.shape[0])
    whole = height.repeat(step, axis=0).repeat(step, axis=1)[: shape[0], : shape[1]]
    rows, columns = shape[0] - whole.shape[0], shape[1] - whole.shape[1]
    return np.pad(whole, ((0, rows), (0, columns)), "edge")[..., None]
