"""Which layers of a drawing are bodies of their own, and which are parts of the body below.

Layers are told apart by how they overlap, at low resolution: shares are those of the layer's
painted area, or of its outline. In doubt, a layer that looks like line or a touch-up is part of the
body below, and a painted shape that sticks out is a body of its own.

Unless the artist says so, only slender shapes are bodies of their own: an arm, a scarf. A head over
a trunk, or a trunk over legs, goes into the picture of what it covers, where the network sees both.
Two round bodies on one another would be as deep as both, and a drawn figure is flatter than that.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy import ndimage

from ..errors import DrawingError
from ..scene import LayerBody
from ..shot import CelLayer, Picture
from .cutout import cut_out
from .ink import find_ink
from .mask import is_line_art
from .morphology import Mask, depth_within, highest, lowest
from .shrink import shrunk

LayerKind = Literal["own", "below", "flat"]

SMALL_PX = 512
"""Longest side at which layers are compared."""
GLAZE = 0.9
"""A layer that nowhere covers more than this is a glaze: light and shade, no body."""
INSIDE = 0.9
"""From this share inside what is below, a layer does not stick out."""
TOUCHING = 0.1
"""Up to this share over what is below, a layer without ink is a tile beside it."""
OUTLINED = 0.5
"""From this share of its outline in ink, a layer is outlined."""
SHARED = 0.5
"""From this share of its outline along the outline of what is below, the two are one."""
DETAIL = 0.06
"""An outlined layer inside another, of less than this share of the other's area, is a detail: an
eye, a button."""
SLENDER = 0.4
"""Up to this share of the width of the body that it covers, a layer is a body of its own."""
NEAR = 2
"""Pixels, at low resolution, within which outlines are the same."""


@dataclass(frozen=True)
class Placed:
    """Where a layer belongs.

    Attributes:
        kind: as the artist would say it.
        body: number of the body whose picture it goes into, bottom first; -1 if it is shared out
            among those under it, or lies flat on them.
    """

    kind: LayerKind
    body: int = -1


@dataclass(frozen=True, eq=False)
class _Shape:
    """A layer at low resolution: what it hides or encloses, and its outline."""

    filled: Mask
    outline: Mask
    line: bool
    glaze: bool
    outlined: bool


def place_layers(
    layers: Sequence[CelLayer], size: tuple[int, int], choices: Iterable[LayerBody] = ()
) -> tuple[Placed, ...]:
    """Where each layer belongs.

    Args:
        layers: bottom first.
        size: (width, height) of the drawing in pixels.
        choices: the artist's own, by the layers' names; they win.
    """
    chosen = {choice.layer: choice.body for choice in choices}
    step = -(-max(size) // SMALL_PX)
    placed: list[Placed] = []
    below: list[_Shape] = []
    bodies: list[Mask] = []
    for layer in layers:
        shape = _shape(layer, size, step)
        choice = chosen.get(layer.name, "auto")
        kind: LayerKind = choice if choice != "auto" else _kind(shape, below)
        body = -1
        if kind == "own" and not shape.filled.any():
            kind = "below"
        if kind == "own" and choice == "auto":
            body = _covered(shape, bodies)
        if kind == "own" and body < 0:
            body = len(bodies)
            bodies.append(shape.filled)
        elif kind == "own":
            kind = "below"
            bodies[body] = bodies[body] | shape.filled
        placed.append(Placed(kind, body))
        if kind != "flat":
            below.append(shape)
    if not bodies and placed:
        first = next((i for i, layer in enumerate(placed) if layer.kind == "below"), 0)
        placed[first] = Placed("own", 0)
    return tuple(placed)


def _covered(shape: _Shape, bodies: Sequence[Mask]) -> int:
    """The body that a layer covers most, if the layer is too wide to lie on it; otherwise -1."""
    shared = [np.count_nonzero(shape.filled & body) for body in bodies]
    if not any(shared):
        return -1
    most = int(np.argmax(shared))
    return most if _width(shape.filled) > SLENDER * _width(bodies[most]) else -1


def _width(area: Mask) -> float:
    """Half the width at the widest place; every second pixel is enough to tell."""
    return float(depth_within(np.pad(area[::2, ::2], 1)).max())


def _kind(shape: _Shape, below: Sequence[_Shape]) -> LayerKind:
    area = np.count_nonzero(shape.filled)
    if not area or not below:
        return "own" if area else "below"
    if shape.line or shape.glaze:
        return "below"
    under = np.logical_or.reduce([other.filled for other in below])
    inside = np.count_nonzero(shape.filled & under) / area
    rim = highest(under & ~lowest(under, 1), NEAR)
    if _share(shape.outline, rim) >= SHARED:
        return "below"
    if not shape.outlined:
        return "own" if TOUCHING < inside < INSIDE else "below"
    if inside < INSIDE:
        return "own"
    covered = max(np.count_nonzero(o.filled) for o in below if (o.filled & shape.filled).any())
    return "own" if area >= DETAIL * covered else "below"


def _shape(layer: CelLayer, size: tuple[int, int], step: int) -> _Shape:
    rows, columns = (-(-side // step) for side in size[::-1])
    top, left = layer.top // step, layer.left // step
    around = (layer.top - top * step, 0), (layer.left - left * step, 0), (0, 0)
    small = shrunk(np.pad(layer.pixels, around), step)
    part = slice(top, top + len(small)), slice(left, left + small.shape[1])
    painted = small[..., 3] >= 128
    line = layer.line or (bool(painted.any()) and is_line_art(painted))
    filled = np.zeros((rows, columns), bool)
    filled[part] = ndimage.binary_fill_holes(painted) if line else painted
    rim = filled & ~lowest(filled, 1)
    # Where the canvas cuts a layer off, it has no outline.
    rim[[0, -1]] = False
    rim[:, [0, -1]] = False
    glaze = bool(layer.pixels[..., 3].max(initial=0) < GLAZE * 255)
    inked = np.zeros_like(filled)
    if not line and not glaze:
        inked[part] = _ink(np.pad(small, ((NEAR, NEAR), (NEAR, NEAR), (0, 0))))
    outlined = _share(rim, highest(inked, NEAR)) >= OUTLINED
    return _Shape(filled, rim, line, glaze, outlined)


def _ink(framed: Picture) -> Mask:
    """The layer's ink, without the empty frame around it, ``NEAR`` pixels wide."""
    try:
        found = find_ink(cut_out(framed))
    except DrawingError:
        found = np.zeros(framed.shape[:2], bool)
    return found[NEAR:-NEAR, NEAR:-NEAR]


def _share(places: Mask, area: Mask) -> float:
    return float(np.mean(area[places])) if places.any() else 0.0
