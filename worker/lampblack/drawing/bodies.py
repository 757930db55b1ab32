"""A cel with its layers to a drawing with its bodies."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..errors import DrawingError
from ..scene import LayerBody
from ..shot import Cel, CelLayer, Picture
from ..warning_collector import collect_warnings
from .decompose import decompose_drawing
from .drawing import Body, Drawing
from .grouping import Placed, place_layers
from .morphology import Mask, from_nearest, near
from .painted import painted_light

MARGIN = 8
"""Empty pixels around the drawing of a body."""
LINE_WIDTH = 0.012
"""Line within this share of the longer side of a painted shape belongs to the shape."""


def decompose_cel(cel: Cel, choices: Iterable[LayerBody] = ()) -> Drawing:
    """Decompose a cel, and each of its bodies if it has several.

    A body is decomposed on its own, with the paint that others cover. Pixels of the whole that
    no body has (blends along edges) go to the nearest one, so that the bodies cover the whole.

    Args:
        choices: the artist's own, by the layers' names; see ``place_layers``.

    Raises, Warns: as ``decompose_drawing``.
    """
    whole = decompose_drawing(cel.pixels, mask=cel.mask, ink=cel.ink)
    if (painted := painted_light(cel.light)) is not None:
        whole = replace(whole, painted=painted)
    if len(cel.layers) < 2:
        return whole
    whole = replace(
        whole,
        owners=_topmost(cel.layers, whole.size),
        layers=tuple(layer.name for layer in cel.layers),
    )
    placed = place_layers(cel.layers, whole.size, choices)
    kinds = [layer.kind for layer in placed]
    if kinds.count("own") < 2 and "flat" not in kinds:
        return whole
    sheets = [sheet for sheet in _sheets(cel.layers, placed, whole.size) if sheet.painted.any()]
    bodies = [body for sheet in sheets if (body := _body(sheet, whole, cel)) is not None]
    if len(bodies) < (1 if "flat" in kinds else 2):
        return whole
    return replace(whole, bodies=_covering(bodies, whole))


def _topmost(layers: Sequence[CelLayer], size: tuple[int, int]) -> NDArray[np.int8]:
    """(H, W) index of the topmost layer that covers at least half of each pixel, or else of one
    that has any paint there."""
    owners = np.full((size[1], size[0]), -1, np.int8)
    for least in (1, 128):
        for index, layer in enumerate(layers):
            height, width = layer.pixels.shape[:2]
            window = owners[layer.top : layer.top + height, layer.left : layer.left + width]
            window[layer.pixels[..., 3] >= least] = index
    return owners


@dataclass(eq=False)
class _Sheet:
    """The picture of a body, at the size of the drawing."""

    name: str
    pixels: Picture
    line: Mask
    painted: Mask

    def add(self, pixels: Picture, *, line: bool) -> None:
        """Paint ``pixels`` over it."""
        drawn = pixels[..., 3] > 0
        self.pixels = np.array(
            Image.alpha_composite(Image.fromarray(self.pixels), Image.fromarray(pixels))
        )
        self.painted = self.painted | drawn
        self.line = self.line | drawn if line else self.line & ~(pixels[..., 3] >= 128)

    def cover(self, pixels: Picture) -> None:
        """Remove what ``pixels`` cover."""
        covered = pixels[..., 3] >= 128
        self.pixels[covered] = 0
        self.painted, self.line = self.painted & ~covered, self.line & ~covered


def _sheets(
    layers: Sequence[CelLayer], placed: Sequence[Placed], size: tuple[int, int]
) -> list[_Sheet]:
    """The bodies' pictures, bottom first. What is part of the bodies below is shared out: each
    pixel goes to the topmost body under it, or to the nearest. What goes into the picture of one
    body covers those that lie on that body."""
    sheets: list[_Sheet] = []
    waiting: list[CelLayer] = []
    for layer, place in zip(layers, placed, strict=True):
        if place.kind == "flat":
            continue
        pixels = layer.placed(size)
        if place.kind == "below" and place.body >= 0:
            sheets[place.body].add(pixels, line=layer.line)
            for sheet in sheets[place.body + 1 :]:
                sheet.cover(pixels)
        elif place.kind == "own":
            none = np.zeros(pixels.shape[:2], bool)
            sheets.append(_Sheet(layer.name, np.zeros_like(pixels), none, none))
            for part in (*waiting, layer):
                sheets[-1].add(part.placed(size), line=part.line)
            waiting = []
        elif not sheets:
            waiting.append(layer)  # under the lowest body: it is part of that
        else:
            owner = _owners(sheets, pixels[..., 3] > 0)
            for index, sheet in enumerate(sheets):
                mine = owner == index
                if mine.any():
                    sheet.add(np.where(mine[..., None], pixels, np.uint8(0)), line=layer.line)
    return sheets


def _owners(sheets: Sequence[_Sheet], drawn: Mask) -> NDArray[np.int16]:
    """(H, W) index of the body to which each drawn pixel of a higher layer belongs, -1 elsewhere.
    A line along the edge of a body belongs to it with its whole width."""
    owner = np.full(drawn.shape, -1, np.int16)
    for index, sheet in reversed([*enumerate(sheets)]):
        free = drawn & (owner < 0)
        if free.any() and sheet.painted.any():
            owner[free & near(sheet.painted, LINE_WIDTH * _longest(sheet.painted))] = index
    free = drawn & (owner < 0)
    if free.any():
        top = np.full(drawn.shape, -1, np.int16)
        for index, sheet in enumerate(sheets):
            top[sheet.painted] = index
        owner[free] = from_nearest(top, top >= 0)[free]
    return owner


def _body(sheet: _Sheet, whole: Drawing, cel: Cel) -> Body | None:
    """The body on a sheet, cropped, so that it is the same wherever it lies in the drawing; None
    if there is too little of it."""
    rows = np.flatnonzero(sheet.painted.any(axis=1))
    columns = np.flatnonzero(sheet.painted.any(axis=0))
    top, left = max(0, int(rows[0]) - MARGIN), max(0, int(columns[0]) - MARGIN)
    crop = slice(top, int(rows[-1]) + 1 + MARGIN), slice(left, int(columns[-1]) + 1 + MARGIN)
    pixels = np.ascontiguousarray(sheet.pixels[crop])
    ink = None
    if cel.ink is not None:
        line = np.where(sheet.line[crop], pixels[..., 3], np.uint8(0))
        ink = np.dstack([np.zeros((*line.shape, 3), np.uint8), line])
    try:
        with collect_warnings():  # they are those of the whole
            drawing = decompose_drawing(pixels, ink=ink)
    except DrawingError:
        return None
    inside = drawing.mask & whole.mask[crop]
    if not inside.any():
        return None
    if not np.array_equal(inside, drawing.mask):
        drawing = _with_mask(drawing, inside)
    return Body(sheet.name, left, top, drawing, np.zeros(inside.shape, bool))


def _covering(bodies: list[Body], whole: Drawing) -> tuple[Body, ...]:
    """The bodies, with the pixels of the whole that none of them has as their rims."""
    top = np.full(whole.mask.shape, -1, np.int16)
    for index, body in enumerate(bodies):
        top[_window(body)][body.drawing.mask] = index
    missing = whole.mask & (top < 0)
    if not missing.any():
        return tuple(bodies)
    nearest = from_nearest(top, top >= 0)
    covering = []
    for index, body in enumerate(bodies):
        mine = missing & (nearest == index)
        if np.count_nonzero(mine[_window(body)]) < np.count_nonzero(mine):
            body = _uncropped(body, mine)
        covering.append(replace(body, rim=mine[_window(body)]))
    return tuple(covering)


def _window(body: Body) -> tuple[slice, slice]:
    height, width = body.drawing.mask.shape
    return slice(body.top, body.top + height), slice(body.left, body.left + width)


def _longest(area: Mask) -> int:
    rows, columns = np.flatnonzero(area.any(axis=1)), np.flatnonzero(area.any(axis=0))
    return int(max(rows[-1] - rows[0], columns[-1] - columns[0])) + 1


def _with_mask(drawing: Drawing, mask: Mask) -> Drawing:
    """The drawing with a smaller mask."""
    return replace(
        drawing,
        mask=mask,
        lines=np.where(mask, drawing.lines, np.float32(0)),
        labels=np.where(mask, drawing.labels, np.int16(-1)),
    )


def _uncropped(body: Body, mine: Mask) -> Body:
    """The body in a crop that also holds ``mine``."""
    rows, columns = np.flatnonzero(mine.any(axis=1)), np.flatnonzero(mine.any(axis=0))
    height, width = body.drawing.mask.shape
    top, left = min(body.top, int(rows[0])), min(body.left, int(columns[0]))
    bottom = max(body.top + height, int(rows[-1]) + 1)
    right = max(body.left + width, int(columns[-1]) + 1)
    around = (
        (body.top - top, bottom - body.top - height),
        (body.left - left, right - body.left - width),
    )
    drawing = body.drawing

    def padded(plane: NDArray[np.generic], empty: int = 0) -> NDArray[np.generic]:
        sides = (*around, *((0, 0),) * (plane.ndim - 2))
        return np.pad(plane, sides, constant_values=empty)

    planes = {
        name: padded(getattr(drawing, name), -1 if name == "labels" else 0)
        for name in ("pixels", "mask", "coverage", "lines", "ink", "ink_colour", "albedo", "labels")
    }
    return Body(body.name, left, top, replace(drawing, **planes), planes["mask"])  # type: ignore[arg-type]
