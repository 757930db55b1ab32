"""Layers composited on a part of the canvas."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np
from PIL import Image

from ..cache import digest
from .blend import Blend, blend_onto
from .document import Group, Key, Layer
from .layer_pictures import Floats, LayerPictures, Picture, Place
from .vector import PALETTE

_EVERYWHERE = ("dst-in", "dst-atop")
"""Ways of compositing that change what is beyond the edges of the upper picture, too."""


@dataclass
class LayerPainter:
    """Composites the layers of one project."""

    pictures: LayerPictures

    def paint(self, layers: Sequence[Layer], frame: int) -> Picture:
        """(H, W, 4) uint8 sRGB, straight alpha: ``layers``, bottom first, at ``frame``.

        Raises:
            ProjectError: a picture is missing or damaged.
        """
        region = self.pictures.region
        if any(layer.touches_up or layer.groups for layer in layers):
            nothing = np.zeros((region.height, region.width, 4), np.float32)
            levels = np.rint(self.paint_on(nothing, layers, frame) * 255)
            return np.asarray(levels, np.uint8)
        canvas = Image.new("RGBA", (region.width, region.height))
        for layer in layers:
            key = layer.key_at(frame)
            if key is not None and not key.blank:
                picture, place = self.pictures.picture(layer, key)
                if key.opacity < 1:
                    picture = picture.copy()
                    picture[..., 3] = np.rint(picture[..., 3] * key.opacity)
                if picture.size:
                    canvas.alpha_composite(Image.fromarray(picture), place)
        return np.array(canvas)

    def paint_on(self, below: Floats, layers: Sequence[Layer], frame: int) -> Floats:
        """``layers``, bottom first, on a picture of the region: both and the result (H, W, 4)
        float32 sRGB from 0 to 1, straight alpha.

        Raises:
            ProjectError: a picture is missing or damaged.
        """
        canvas = below.copy()
        self._paint(canvas, layers, frame, 0)
        return canvas

    def _paint(self, canvas: Floats, layers: Sequence[Layer], frame: int, depth: int) -> None:
        """Paint ``layers``, which share the groups down to ``depth``, on ``canvas``."""

        def inner(layer: Layer) -> Group | None:
            return layer.groups[depth] if len(layer.groups) > depth else None

        for group, members in groupby(layers, inner):
            if group is not None:
                self._paint_group(canvas, group, list(members), frame, depth + 1)
                continue
            for layer in members:
                key = layer.key_at(frame)
                if key is not None and not key.blank:
                    picture, place = self.pictures.picture(layer, key)
                    if picture.size and layer.blend in _EVERYWHERE:
                        picture, place = self._widened(picture, place), (0, 0)
                    _lay_on(canvas, picture, place, layer.blend, key.opacity, layer.clipped)

    def _paint_group(
        self, canvas: Floats, group: Group, layers: Sequence[Layer], frame: int, depth: int
    ) -> None:
        painted = canvas.copy() if group.passes else np.zeros_like(canvas)
        self._paint(painted, layers, frame, depth)
        shown = self.pictures.shown(group.masks)
        if group.passes:
            share = group.opacity if shown is None else group.opacity * shown[..., None]
            canvas[:] = _mixed(canvas, painted, share)
            return
        if shown is not None:
            painted[..., 3] *= shown
        _lay_on(canvas, painted, (0, 0), group.blend, group.opacity, group.clipped)

    def _widened(self, picture: Picture, place: Place) -> Picture:
        """``picture`` with nothing around it, as large as the region."""
        whole = np.zeros((self.pictures.region.height, self.pictures.region.width, 4), np.uint8)
        left, top = place
        whole[top : top + picture.shape[0], left : left + picture.shape[1]] = picture
        return whole

    def identity(self, layer: Layer, key: Key) -> bytes:
        """A digest of all that determines what ``paint`` makes of a key."""
        pictures = self.pictures
        found: list[object] = [pictures.region, pictures.origin, layer.kind]
        found += [key.left, key.top, key.opacity, key.inline or pictures.digest(key.file)]
        if layer.touches_up or layer.groups:
            found.append((layer.blend, layer.clipped, layer.groups))
        for mask in (*key.masks, *(mask for group in layer.groups for mask in group.masks)):
            found += [mask, pictures.digest(mask.file)]
        if layer.kind == "vector":
            found.append(pictures.digest(PALETTE))
        return digest(*found).encode()


def _lay_on(
    canvas: Floats,
    picture: Picture | Floats,
    place: Place,
    blend: Blend,
    opacity: float,
    clipped: bool,
) -> None:
    """Blend ``picture`` with ``canvas``, with its corner at ``place``."""
    left, top = place
    part = canvas[top : top + picture.shape[0], left : left + picture.shape[1]]
    blend_onto(part, picture, blend, opacity, clipped=clipped)


def _mixed(before: Floats, after: Floats, share: float | Floats) -> Floats:
    """Between two pictures, (H, W, 4) float32 from 0 to 1 with straight alpha: ``before`` where
    ``share`` is 0, ``after`` where it is 1."""
    first, last = (
        np.concatenate([one[..., :3] * one[..., 3:], one[..., 3:]], axis=2)
        for one in (before, after)
    )
    mixed = first + share * (last - first)
    mixed[..., :3] /= np.maximum(mixed[..., 3:], 1e-6)
    return np.asarray(np.clip(mixed, 0, 1), np.float32)
