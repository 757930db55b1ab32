"""A drawing's layers as bytes, cut to a crop at device resolution, for previews."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..colour import linear
from ..drawing.drawing import Drawing
from ..drawing.palette import Palette
from .borders import mixed_labels
from .resample import Box

Bytes = NDArray[np.uint8]
Label = TypeVar("Label", np.int8, np.int16)
_FARTHEST = 12
_LINEAR = linear(np.arange(256) / 255)


@dataclass(frozen=True)
class ByteLayers:
    """The layers of a ``Drawing``, H x W, in 17 bytes a pixel.

    Attributes:
        pixels: (H, W, 4) uint8 sRGB, premultiplied.
        albedo: (H, W, 3) uint8 sRGB.
        ink: (H, W) uint8. ink_colour: (H, W, 3) uint8 sRGB.
        coverage: (H, W) uint8.
        labels: (H, W) int16 index into ``palette.swatches``, -1 outside.
        others, shares: (H, W) int16 and uint8, the second label and its share of the pixel; see
            ``borders.mixed_labels``.
        palette: the flat colours.
        edges: (H, W) uint8, see ``edge_distance``, and ``edge_unit``, the pixels of the drawing for
            1 in it. None where there is no rim.
        owners, layers, painted: see ``Drawing``. A part has no painted light.
    """

    pixels: Bytes
    albedo: Bytes
    ink: Bytes
    ink_colour: Bytes
    coverage: Bytes
    labels: NDArray[np.int16]
    others: NDArray[np.int16]
    shares: Bytes
    palette: Palette
    edges: Bytes | None = None
    edge_unit: float = 0.0
    owners: NDArray[np.int8] | None = None
    layers: tuple[str, ...] = ()
    painted: NDArray[np.float32] | None = None

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self.pixels.shape[1], self.pixels.shape[0]

    def albedo_at(self, row: NDArray[np.intp], column: NDArray[np.intp]) -> NDArray[np.float32]:
        """(V, 3) sRGB in 0..1 of V pixels."""
        return self.albedo[row, column].astype(np.float32) / 255.0

    @property
    def nbytes(self) -> int:
        """Bytes of all layers."""
        return sum(a.nbytes for a in vars(self).values() if isinstance(a, np.ndarray))

    def cut(self, crop: Box, size: tuple[int, int]) -> ByteLayers:
        """The part in ``crop`` at ``size`` (width, height) pixels; empty past the drawing's edges.
        Averaged when it shrinks, interpolated when it enlarges."""
        place = _place(crop, size, self.size)
        albedo = _resized(self.albedo, place, size)
        labels = _nearest(self.labels, place, size)
        # Where a pixel becomes several, its mixture does too.
        larger = max(size[0] / crop[2], size[1] / crop[3])
        reach = min(_FARTHEST, math.ceil(1.5 * larger)) if larger > 1 else 1
        others, shares = _blends(labels, albedo, self.palette, reach)
        return ByteLayers(
            pixels=_resized(self.pixels, place, size),
            albedo=albedo,
            ink=_resized(self.ink, place, size),
            ink_colour=_ink_colour(self, place, size),
            coverage=_resized(self.coverage, place, size),
            labels=labels,
            others=others,
            shares=shares,
            palette=self.palette,
            edges=None if self.edges is None else _resized(self.edges, place, size),
            edge_unit=self.edge_unit,
            owners=None if self.owners is None else _nearest(self.owners, place, size),
            layers=self.layers,
        )


def byte_layers_of(drawing: Drawing) -> ByteLayers:
    """The layers of ``drawing``, rounded."""
    others, shares = _blends(drawing.labels, _rounded(drawing.albedo), drawing.palette, 1)
    return ByteLayers(
        pixels=premultiplied(drawing.pixels),
        albedo=_rounded(drawing.albedo),
        ink=_rounded(drawing.ink),
        ink_colour=_rounded(drawing.ink_colour),
        coverage=_rounded(drawing.coverage),
        labels=drawing.labels,
        others=others,
        shares=shares,
        palette=drawing.palette,
        owners=drawing.owners,
        layers=drawing.layers,
        painted=drawing.painted,
    )


def premultiplied(pixels: Bytes) -> Bytes:
    """(H, W, 4) straight alpha to premultiplied."""
    alpha = pixels[..., 3:].astype(np.uint16)
    colour = (pixels[..., :3] * alpha + 127) // 255
    return np.asarray(np.concatenate([colour, alpha], axis=2).astype(np.uint8))


def cut_picture(picture: Bytes, crop: Box, size: tuple[int, int]) -> Bytes:
    """The part of a premultiplied (H, W, 4) picture in ``crop``, as ``ByteLayers.cut`` cuts."""
    return _resized(picture, _place(crop, size, (picture.shape[1], picture.shape[0])), size)


@dataclass(frozen=True)
class _Place:
    """``box`` (left, top, right, bottom) of the drawing becomes ``size`` pixels at ``at`` (left,
    top) of the result."""

    box: Box
    at: tuple[int, int]
    size: tuple[int, int]


def _place(crop: Box, size: tuple[int, int], whole: tuple[int, int]) -> _Place | None:
    """The place of a crop's part of the drawing; None if the crop has no part of it."""
    x, y, width, height = crop
    step = width / size[0], height / size[1]
    ends = []
    for start, pace, count, limit in zip((x, y), step, size, whole, strict=True):
        first = max(0, int(np.ceil(-start / pace - 1e-6)))
        last = min(count, int(np.floor((limit - start) / pace + 1e-6)))
        if last <= first:
            return None
        ends.append((first, last, max(0.0, start + first * pace), min(limit, start + last * pace)))
    (left, right, x0, x1), (top, bottom, y0, y1) = ends
    return _Place((x0, y0, x1, y1), (left, top), (right - left, bottom - top))


def _resized(layer: Bytes, place: _Place | None, size: tuple[int, int]) -> Bytes:
    whole = np.zeros((size[1], size[0], *layer.shape[2:]), np.uint8)
    if place is not None:
        image = (
            Image.fromarray(layer, "RGBa") if layer.shape[2:] == (4,) else Image.fromarray(layer)
        )
        smaller = place.size[0] < place.box[2] - place.box[0]
        method = Image.Resampling.BOX if smaller else Image.Resampling.BILINEAR
        part = np.asarray(image.resize(place.size, method, place.box))
        (left, top), (width, height) = place.at, place.size
        whole[top : top + height, left : left + width] = part
    return whole


def _nearest(labels: NDArray[Label], place: _Place | None, size: tuple[int, int]) -> NDArray[Label]:
    whole = np.full((size[1], size[0]), -1, labels.dtype)
    if place is not None:
        x0, y0, x1, y1 = place.box
        (left, top), (width, height) = place.at, place.size
        columns = np.minimum(x0 + (np.arange(width) + 0.5) * (x1 - x0) / width, labels.shape[1] - 1)
        rows = np.minimum(y0 + (np.arange(height) + 0.5) * (y1 - y0) / height, labels.shape[0] - 1)
        part = labels[np.ix_(rows.astype(np.intp), columns.astype(np.intp))]
        whole[top : top + height, left : left + width] = part
    return whole


def _blends(
    labels: NDArray[np.int16], albedo: Bytes, palette: Palette, reach: int
) -> tuple[NDArray[np.int16], Bytes]:
    others, shares = mixed_labels(labels, _LINEAR[albedo], palette, reach)
    return others, _rounded(shares)


def _ink_colour(layers: ByteLayers, place: _Place | None, size: tuple[int, int]) -> Bytes:
    """The ink's colour, weighted by the ink: without ink it is undefined."""
    inked = np.concatenate([layers.ink_colour, np.zeros_like(layers.ink_colour[..., :1])], axis=2)
    inked[..., 3] = layers.ink
    part = _resized(premultiplied(inked), place, size)
    weight = np.maximum(part[..., 3:].astype(np.uint16), 1)
    colour = part[..., :3].astype(np.uint16) * 255 // weight
    return np.asarray(np.minimum(colour, 255).astype(np.uint8))


def _rounded(layer: NDArray[np.float32]) -> Bytes:
    return np.asarray(np.rint(np.clip(layer, 0, 1) * 255).astype(np.uint8))
