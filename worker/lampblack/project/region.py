"""A part of the canvas."""

from __future__ import annotations

from dataclasses import dataclass


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
