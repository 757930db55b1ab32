"""The flat colours of a drawing, keyed by their sRGB value."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Swatch:
    """One flat colour: ``#rrggbb`` in sRGB, and how many pixels of the fill wear it."""

    colour: str
    pixels: int


@dataclass(frozen=True)
class Palette:
    """Swatches, most used first."""

    swatches: tuple[Swatch, ...]
