"""A drawing as its raw planes: what a drawing program sends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from .decompose import decompose_drawing
from .drawing import Drawing

Bytes = NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class DrawingPlanes:
    """Planes of one size.

    Attributes:
        pixels: (H, W, 4) uint8, sRGB, straight alpha.
        mask: (H, W) uint8, 255 inside the character; None: found in the pixels.
        ink: (H, W) uint8, 255 where there is ink; None: found in the pixels.
    """

    pixels: Bytes
    mask: Bytes | None = None
    ink: Bytes | None = None

    @property
    def nbytes(self) -> int:
        """Bytes of all planes."""
        return sum(
            plane.nbytes for plane in (self.pixels, self.mask, self.ink) if plane is not None
        )

    def decompose(self) -> Drawing:
        """The drawing in these planes.

        Raises, Warns: as ``decompose_drawing``.
        """
        mask, ink = self.pictures
        return decompose_drawing(self.pixels, mask=mask, ink=ink)

    @property
    def pictures(self) -> tuple[Bytes | None, Bytes | None]:
        """Mask and ink as pictures, (H, W, 4) uint8, as ``decompose_drawing`` takes them."""
        return (
            None if self.mask is None else _grey(self.mask),
            None if self.ink is None else _grey(np.invert(self.ink)),
        )

    def reduced(self, step: int) -> DrawingPlanes:
        """The same planes with blocks of ``step`` pixels averaged, colours by their alpha."""
        if step == 1:
            return self
        pixels = Image.fromarray(self.pixels).convert("RGBa").reduce(step).convert("RGBA")
        mask, ink = (
            None if plane is None else np.asarray(Image.fromarray(plane).reduce(step))
            for plane in (self.mask, self.ink)
        )
        return DrawingPlanes(np.asarray(pixels), mask, ink)


def _grey(plane: Bytes) -> Bytes:
    """An opaque grey picture, as masks and ink are read."""
    return np.dstack([plane, plane, plane, np.full_like(plane, 255)])
