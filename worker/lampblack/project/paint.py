"""Layers composited on a part of the canvas."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..cache import digest
from ..drawing import read_picture
from ..errors import DrawingError, ProjectError
from .archive import Archive
from .blend import Blend, blended
from .document import Group, Key, Layer
from .region import Region
from .vector import PALETTE, VectorPictures

Picture = NDArray[np.uint8]


@dataclass
class LayerPainter:
    """Composites the layers of one project.

    Args:
        region: the part of the canvas that is painted.
        origin: Pencil2D's origin, (x, y) canvas pixels.
        vectors: renders the vector layers.
    """

    archive: Archive
    region: Region
    origin: tuple[int, int]
    vectors: VectorPictures
    _digests: dict[str, str] = field(default_factory=dict)

    def paint(self, layers: Sequence[Layer], frame: int) -> Picture:
        """(H, W, 4) uint8 sRGB, straight alpha: ``layers``, bottom first, at ``frame``.

        Raises:
            ProjectError: a picture is missing or damaged.
        """
        return np.array(self._group(layers, frame, 0))

    def _group(self, layers: Sequence[Layer], frame: int, depth: int) -> Image.Image:
        """``layers``, which share the groups down to ``depth``."""
        canvas = Image.new("RGBA", (self.region.width, self.region.height))

        def inner(layer: Layer) -> Group | None:
            return layer.groups[depth] if len(layer.groups) > depth else None

        for group, members in groupby(layers, inner):
            if group is not None:
                painted = self._group(list(members), frame, depth + 1)
                _lay_on(canvas, np.asarray(painted), (0, 0), group.blend, group.opacity)
                continue
            for layer in members:
                key = layer.key_at(frame)
                if key is not None and not key.blank:
                    self._lay(canvas, layer, key)
        return canvas

    def identity(self, layer: Layer, key: Key) -> bytes:
        """A digest of all that determines what ``paint`` makes of a key."""
        found: list[object] = [self.region, self.origin, layer.kind, key.left, key.top, key.opacity]
        found.append(key.inline or self._digest(key.file))
        if layer.touches_up or layer.groups:
            found.append((layer.blend, layer.clipped, layer.groups))
        if layer.kind == "vector":
            found.append(self._digest(PALETTE))
        return digest(*found).encode()

    def _lay(self, canvas: Image.Image, layer: Layer, key: Key) -> None:
        try:
            if layer.kind == "vector":
                picture, left, top = self.vectors.picture(layer, key, self.region), 0, 0
            else:
                name = f"{key.file} of frame {key.frame} on layer {layer.name!r}"
                data = self.archive.read(key.file)
                if self._digests.get(key.file, digest(data)) != digest(data):
                    raise ProjectError(
                        f"{name} was changed while the shot was rendered.", "Render the shot again."
                    )
                picture = read_picture(io.BytesIO(data), name)
                picture, left, top = self._placed(picture, key)
        except ProjectError:
            raise
        except DrawingError as error:
            raise ProjectError(error.what, error.remedy, error.details) from error
        # A picture may be anywhere: only its part on the canvas is painted.
        picture = picture[max(0, -top) :, max(0, -left) :]
        picture = picture[: max(0, canvas.height - top), : max(0, canvas.width - left)]
        if not picture.size:
            return
        place = max(0, left), max(0, top)
        _lay_on(canvas, picture, place, layer.blend, key.opacity, clipped=layer.clipped)

    def _placed(self, picture: Picture, key: Key) -> tuple[Picture, int, int]:
        """A bitmap in the region's pixels, and its place there."""
        region = self.region
        left, top = key.left + self.origin[0], key.top + self.origin[1]
        if region.scale == 1:
            return picture, left - int(region.left), top - int(region.top)
        return _reduced(
            picture,
            left * region.scale - region.left,
            top * region.scale - region.top,
            region.scale,
        )

    def _digest(self, name: str) -> str:
        if name not in self._digests:
            try:
                self._digests[name] = digest(self.archive.read(name))
            except ProjectError as error:  # reported when the frame is painted
                self._digests[name] = digest(name, str(error))
        return self._digests[name]


def _lay_on(
    canvas: Image.Image,
    picture: Picture,
    place: tuple[int, int],
    blend: Blend,
    opacity: float,
    *,
    clipped: bool = False,
) -> None:
    """Paint ``picture`` on ``canvas``, with its corner at ``place``."""
    if blend == "normal" and not clipped:
        if opacity < 1:
            picture = picture.copy()
            picture[..., 3] = np.rint(picture[..., 3] * opacity)
        canvas.alpha_composite(Image.fromarray(picture), place)
        return
    whole = np.zeros((canvas.height, canvas.width, 4), np.uint8)
    left, top = place
    whole[top : top + picture.shape[0], left : left + picture.shape[1]] = picture
    below = np.asarray(canvas)
    canvas.paste(Image.fromarray(blended(below, whole, blend, opacity, clipped=clipped)))


def _reduced(picture: Picture, left: float, top: float, scale: float) -> tuple[Picture, int, int]:
    """``picture`` made smaller by ``scale`` with its corner at (left, top), on whole pixels. Each
    is the mean of what it covers. Returns it with its new corner."""
    height, width = picture.shape[:2]
    place = []
    for start, side in ((left, width), (top, height)):
        first = math.floor(start)
        count = max(1, math.ceil(start + side * scale) - first)
        before = math.ceil((start - first) / scale)
        past = math.ceil((first + count - start) / scale) - side
        place.append((first, count, before, max(0, past), before - (start - first) / scale))
    (x, columns, before_x, past_x, skip_x), (y, rows, before_y, past_y, skip_y) = place
    padded = np.pad(picture, ((before_y, past_y), (before_x, past_x), (0, 0)))
    box = (skip_x, skip_y, skip_x + columns / scale, skip_y + rows / scale)
    box = (*box[:2], min(box[2], padded.shape[1]), min(box[3], padded.shape[0]))
    image = Image.fromarray(padded).convert("RGBa")
    smaller = image.resize((columns, rows), Image.Resampling.BOX, box)
    return np.asarray(smaller.convert("RGBA")), x, y
