"""The pictures in a file of Krita."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..drawing import read_picture
from ..drawing.profile import to_srgb
from ..errors import ProjectError
from ..files import understood
from .archive import MAX_FILE_BYTES, Zipped
from .kra_tiles import unpacked

MERGED = "mergedimage.png"
"""The picture of all layers."""


@dataclass(frozen=True)
class Stored:
    """How a file of tiles is read: ``place`` is its origin on the canvas, (x, y)."""

    place: tuple[int, int] = (0, 0)
    mask: bool = False

    @property
    def default(self) -> bytes:
        """The pixel where nothing is drawn, if the file does not say."""
        return b"\0" if self.mask else bytes(4)


class KraFile:
    """The pictures of one file.

    Args:
        name: of the image, and of the folder of its layers.
        size: (width, height) of the canvas.

    Attributes:
        stored: how each file is read, by its name in the folder of layers.
    """

    def __init__(self, archive: Zipped, name: str, size: tuple[int, int]) -> None:
        self.path: Path = archive.path
        self.size = size
        self.stored: dict[str, Stored] = {}
        self._archive = archive
        self._folder = name

    def layer(self, name: str) -> bytes:
        """A file of the folder of layers.

        Raises:
            ProjectError: it is missing, damaged or too large.
        """
        return self._archive.entry(f"{self._folder}/layers/{name}")

    def has(self, name: str) -> bool:
        return name == MERGED or self._archive.holds(f"{self._folder}/layers/{name}")

    def read(self, name: str, limit: int = MAX_FILE_BYTES) -> bytes:
        """Tiles are followed by the pixel where there is none."""
        if name == MERGED:
            return self._archive.entry(MERGED, limit)
        default = self.stored[name].default
        if self.has(f"{name}.defaultpixel"):
            given = self.layer(f"{name}.defaultpixel")
            default = given if len(given) == len(default) else default
        return self.layer(name) + default

    def picture(self, name: str, data: bytes, subject: str) -> NDArray[np.uint8]:
        if name == MERGED:
            return read_picture(io.BytesIO(data), subject)
        stored = self.stored[name]
        cut = len(data) - len(stored.default)
        damaged = ProjectError(
            f"{subject} in {self.path.name} is damaged.",
            "Save it again in Krita, or restore a backup.",
        )
        with understood(damaged):
            pixels = unpacked(memoryview(data)[:cut], self.size, stored.place, data[cut:])
        if stored.mask:
            return np.dstack([pixels] * 3 + [np.full_like(pixels, 255)])
        image = Image.fromarray(np.ascontiguousarray(pixels[..., [2, 1, 0, 3]]))
        icc = f"{self._folder}/annotations/icc"
        if self._archive.holds(icc):
            image.info["icc_profile"] = self._archive.entry(icc)
        return np.array(to_srgb(image, subject))
