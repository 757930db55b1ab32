"""A part of the canvas."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Region:
    """A rectangle in canvas pixels. It may begin outside the canvas."""

    left: int
    top: int
    width: int
    height: int
