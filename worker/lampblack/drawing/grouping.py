"""Which layers of a drawing are bodies of their own, and which are parts of the body below.

Layers are told apart by how they overlap, at low resolution: shares are those of the layer's
painted area, or of its outline. In doubt, a layer that looks like line or a touch-up is part of the
body below, and a painted shape that sticks out is a body of its own.
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
from .morphology import Mask, highest, lowest
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
NEAR = 2
"""Pixels, at low resolution, within which outlines are the same."""


@dataclass(frozen=True, eq=False)
class _Shape:
    """A layer at low resolution: where it is painted, and what it hides or encloses."""

    painted: Mask
    filled: Mask
    outline: Mask
    line: bool
    glaze: bool
    outlined: bool


def layer_kinds(
    layers: Sequence[CelLayer], size: tuple[int, int], choices: Iterable[LayerBody] = ()
) -> tuple[LayerKind, ...]:
    """The kind of each layer.

    Args:
        layers: bottom first.
        size: (width, height) of the drawing in pixels.
        choices: the artist's own, by the layers' names; they win.
    """
    chosen = {choice.layer: choice.body for choice in choices}
    step = -(-max(size) // SMALL_PX)
    kinds: list[LayerKind] = []
    below: list[_Shape] = []
    for layer in layers:
        shape = _shape(layer, size, step)
        choice = chosen.get(layer.name, "auto")
        kind: LayerKind = choice if choice != "auto" else _kind(shape, below)
        if kind == "own" and not shape.filled.any():
            kind = "below"
        kinds.append(kind)
        if kind != "flat":
            below.append(shape)
    if "own" not in kinds and kinds:
        kinds[next((i for i, kind in enumerate(kinds) if kind == "below"), 0)] = "own"
    return tuple(kinds)


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
    small = shrunk(layer.placed(size), step)
    cover = small[..., 3]
    painted = cover >= 128
    line = layer.line or (bool(painted.any()) and is_line_art(painted))
    filled = np.asarray(ndimage.binary_fill_holes(painted)) if line else painted
    rim = filled & ~lowest(filled, 1)
    # Where the canvas cuts a layer off, it has no outline.
    rim[[0, -1]] = False
    rim[:, [0, -1]] = False
    glaze = bool(layer.pixels[..., 3].max(initial=0) < GLAZE * 255)
    outlined = not line and not glaze and _share(rim, _ink(small, NEAR)) >= OUTLINED
    return _Shape(painted, filled, rim, line, glaze, outlined)


def _ink(small: Picture, reach: int) -> Mask:
    """Pixels within ``reach`` of the layer's ink."""
    try:
        return highest(find_ink(cut_out(small)), reach)
    except DrawingError:
        return np.zeros(small.shape[:2], bool)


def _share(places: Mask, area: Mask) -> float:
    return np.count_nonzero(places & area) / max(1, np.count_nonzero(places))
