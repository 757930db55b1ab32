"""One frame of drawn art, decomposed into the layers that the later stages need."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .palette import Palette


@dataclass(frozen=True)
class Drawing:
    """A drawing in canvas pixels (row 0 at the top), H x W.

    Compositing ``ink_colour`` over ``albedo`` with coverage ``ink``, and the result over the
    background with ``coverage``, gives ``pixels`` back to within rounding. So a character lit
    by white light of unit irradiance *is* the drawing.

    Attributes:
        pixels: (H, W, 4) uint8, sRGB, straight alpha, as read.
        mask: (H, W) bool, True inside the character (its line included).
        coverage: (H, W) float32 in 0..1, share of the pixel that the character covers
            (anti-aliased edge); 0 far outside the mask. For transparent art this is its
            alpha, except 1 inside line art, which is lit as if drawn on white paper.
        lines: (H, W) float32 in 0..1, the line drawing from which the normals are predicted:
            ink, or colour borders where no ink was drawn; 0 outside the mask.
        ink: (H, W) float32 in 0..1, coverage of the artist's line over the fill.
        ink_colour: (H, W, 3) float32 sRGB in 0..1, colour of the line where ``ink`` > 0.
        albedo: (H, W, 3) float32 sRGB in 0..1, the fill, continued under the line and a few
            pixels past the mask.
        labels: (H, W) int16 index into ``palette.swatches`` of the fill, -1 outside.
        palette: the flat colours of the fill.
        owners: (H, W) int8 index into ``layers`` of the topmost layer with paint here, -1 where
            there is none; None if the layers are not known.
        layers: the artist's names of the layers.
        painted: (h, w, 3) float32 scene-linear, painted light over all of the drawing, at low
            resolution; None if there is none.
        bodies: its parts, bottom first, if it was drawn on several layers that are bodies of
            their own. Then each of them has a surface, and this drawing has none.
    """

    pixels: NDArray[np.uint8]
    mask: NDArray[np.bool_]
    coverage: NDArray[np.float32]
    lines: NDArray[np.float32]
    ink: NDArray[np.float32]
    ink_colour: NDArray[np.float32]
    albedo: NDArray[np.float32]
    labels: NDArray[np.int16]
    palette: Palette
    bodies: tuple[Body, ...] = ()
    owners: NDArray[np.int8] | None = None
    layers: tuple[str, ...] = ()
    painted: NDArray[np.float32] | None = None

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self.pixels.shape[1], self.pixels.shape[0]

    @property
    def nbytes(self) -> int:
        """Bytes of all layers, and those of its bodies."""
        own = sum(a.nbytes for a in vars(self).values() if isinstance(a, np.ndarray))
        return own + sum(body.drawing.nbytes for body in self.bodies)

    def albedo_at(self, row: NDArray[np.intp], column: NDArray[np.intp]) -> NDArray[np.float32]:
        """(V, 3) sRGB in 0..1 of V pixels."""
        found: NDArray[np.float32] = self.albedo[row, column]
        return found


@dataclass(frozen=True, eq=False)
class Body:
    """A part of a drawing that lies on a layer of its own, with what is drawn on it.

    Attributes:
        name: the artist's name of its lowest layer.
        left, top: corner of ``drawing`` in the whole drawing.
        drawing: the part alone, also where other bodies cover it.
        rim: (h, w) bool, further pixels of the whole that its surface covers: blends along edges
            that are in no body's mask.
    """

    name: str
    left: int
    top: int
    drawing: Drawing
    rim: NDArray[np.bool_]
