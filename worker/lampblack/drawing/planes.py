"""A drawing as its raw planes: what a drawing program sends."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..scene import LayerBody
from ..shot import Cel, CelLayer, cropped_layer
from .bodies import decompose_cel
from .drawing import Drawing
from .shrink import shrunk

Bytes = NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class DrawingPlanes:
    """Planes of one size.

    Attributes:
        pixels: (H, W, 4) uint8, sRGB, straight alpha.
        mask: (H, W) uint8, 255 inside the character; None: found in the pixels.
        ink: (H, W) uint8, 255 where there is ink; None: found in the pixels.
        layers: the layers of the pixels, bottom first, if they are known.
        light: (H, W, 4) uint8, sRGB, straight alpha: painted light, which is not in the pixels.
    """

    pixels: Bytes
    mask: Bytes | None = None
    ink: Bytes | None = None
    layers: tuple[CelLayer, ...] = ()
    light: Bytes | None = None

    @property
    def nbytes(self) -> int:
        """Bytes of all planes."""
        planes = [
            self.pixels,
            self.mask,
            self.ink,
            self.light,
            *(layer.pixels for layer in self.layers),
        ]
        return sum(plane.nbytes for plane in planes if plane is not None)

    def decompose(self, choices: Iterable[LayerBody] = ()) -> Drawing:
        """The drawing in these planes, with its bodies; see ``decompose_cel``.

        Raises, Warns: as ``decompose_drawing``.
        """
        return decompose_cel(Cel(self.pixels, *self.pictures, self.layers, self.light), choices)

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
        mask, ink = (
            None if plane is None else np.asarray(Image.fromarray(plane).reduce(step))
            for plane in (self.mask, self.ink)
        )
        size = self.pixels.shape[1], self.pixels.shape[0]
        layers = (
            cropped_layer(layer.name, shrunk(layer.placed(size), step), line=layer.line)
            for layer in self.layers
        )
        kept = tuple(layer for layer in layers if layer is not None)
        light = None if self.light is None else shrunk(self.light, step)
        return DrawingPlanes(shrunk(self.pixels, step), mask, ink, kept, light)


def _grey(plane: Bytes) -> Bytes:
    """An opaque grey picture, as masks and ink are read."""
    return np.dstack([plane, plane, plane, np.full_like(plane, 255)])
