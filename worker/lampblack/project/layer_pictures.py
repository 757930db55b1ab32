"""The pictures of layers, in the pixels of a part of the canvas."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..cache import digest
from ..errors import DrawingError, ProjectError
from .archive import Archive
from .document import Key, Layer, Mask
from .region import Region
from .vector import VectorPictures

Picture = NDArray[np.uint8]
Floats = NDArray[np.float32]
Place = tuple[int, int]


@dataclass
class LayerPictures:
    """Reads the pictures of one project.

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

    def picture(self, layer: Layer, key: Key) -> tuple[Picture, Place]:
        """The part of a drawing that is in the region, (H, W, 4) uint8, without what its masks
        hide, and (left, top) of it there. It may be empty.

        Raises:
            ProjectError: it is missing or damaged.
        """
        try:
            if layer.kind == "vector":
                picture, left, top = self.vectors.picture(layer, key, self.region), 0, 0
            else:
                picture = self._read(key.file, f"frame {key.frame} on layer {layer.name!r}")
                picture, left, top = self._placed(picture, key.left, key.top)
        except ProjectError:
            raise
        except DrawingError as error:
            raise ProjectError(error.what, error.remedy, error.details) from error
        picture, place = self._cut(picture, left, top)
        shown = self.shown(key.masks) if picture.size else None
        return masked(picture, None if shown is None else _part(shown, picture, place)), place

    def shown(self, masks: Sequence[Mask]) -> Floats | None:
        """(H, W) float32, 0 to 1: how much of each pixel of the region ``masks`` show; None if
        there are none."""
        shown: Floats | None = None
        for mask in masks:
            picture = self._read(mask.file, "a mask")
            picture, left, top = self._placed(picture, mask.left, mask.top)
            picture, place = self._cut(picture, left, top)
            seen = np.full((self.region.height, self.region.width), mask.outside, np.float32)
            if picture.size:
                part = _part(seen, picture, place)
                part += picture[..., 3] / np.float32(255) * (picture[..., 0] - part)
            shows = 1 - np.float32(mask.density) * (1 - seen / 255.0)
            shown = shows if shown is None else shown * shows
        return shown

    def digest(self, name: str) -> str:
        """A digest of a file's content."""
        if name not in self._digests:
            try:
                self._digests[name] = digest(self.archive.read(name))
            except ProjectError as error:  # reported when the frame is painted
                self._digests[name] = digest(name, str(error))
        return self._digests[name]

    def _read(self, file: str, of: str) -> Picture:
        name = f"{file} of {of}"
        data = self.archive.read(file)
        known = self._digests.get(file)
        if known is not None and known != digest(data):
            raise ProjectError(
                f"{name} was changed while the shot was rendered.", "Render the shot again."
            )
        return self.archive.picture(file, data, name)

    def _placed(self, picture: Picture, left: int, top: int) -> tuple[Picture, int, int]:
        """A bitmap in the region's pixels, and its place there."""
        region = self.region
        left, top = left + self.origin[0], top + self.origin[1]
        if region.scale == 1:
            return picture, left - int(region.left), top - int(region.top)
        return _reduced(
            picture,
            left * region.scale - region.left,
            top * region.scale - region.top,
            region.scale,
        )

    def _cut(self, picture: Picture, left: int, top: int) -> tuple[Picture, Place]:
        """The part of a picture that is in the region, and its place there."""
        picture = picture[max(0, -top) :, max(0, -left) :]
        height, width = max(0, self.region.height - top), max(0, self.region.width - left)
        return picture[:height, :width], (max(0, left), max(0, top))


def masked(picture: Picture, shown: Floats | None) -> Picture:
    """``picture`` with its alpha times ``shown``, (H, W) 0 to 1."""
    if shown is None:
        return picture
    alpha = np.rint(picture[..., 3] * shown).astype(np.uint8)
    return np.dstack([picture[..., :3], alpha])


def _part(whole: Floats, picture: Picture, place: Place) -> Floats:
    """The part of ``whole`` that ``picture`` covers."""
    left, top = place
    return whole[top : top + picture.shape[0], left : left + picture.shape[1]]


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
