"""A part of the canvas."""

from __future__ import annotations

from dataclasses import dataclass

from ..camera import Affine


@dataclass(frozen=True)
class Region:
    """A rectangle of the canvas, painted at ``scale`` pixels for each pixel of the canvas, at most
    1. The rectangle is in painted pixels, and may begin outside the canvas. At scale 1 it begins on
    a whole pixel."""

    left: float
    top: float
    width: int
    height: int
    scale: float = 1.0

    def through(self, view: Affine) -> Affine:
        """From the region's pixels to those of a picture; ``view`` is from the canvas to it."""
        a, b, c, d, e, f = view
        a, b, d, e = (each / self.scale for each in (a, b, d, e))
        return a, b, c + a * self.left + b * self.top, d, e, f + d * self.left + e * self.top
