"""Refinement levels: how finely the light of a preview is traced."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

MISSING, PASSING, LOW, CONVERGED = -1, 0, 1, 2
"""Levels of a contribution's light: none, traced while something changed, and the two levels of
``REFINEMENT``."""


@dataclass(frozen=True)
class RefinementLevel:
    """Lighting pixels along the longer side, samples per pixel, and the number of samples between
    two checks for newer work."""

    longest: int
    spp: int
    at_once: int


MOVING = (RefinementLevel(64, 1, 1), RefinementLevel(96, 1, 1), RefinementLevel(128, 1, 1))
"""Levels for a light while something changes. The finest one that is fast enough is used."""

REFINEMENT: dict[Literal["light", "ambient", "floor"], tuple[RefinementLevel, RefinementLevel]] = {
    "light": (RefinementLevel(192, 4, 2), RefinementLevel(384, 8, 1)),
    "ambient": (RefinementLevel(128, 8, 4), RefinementLevel(384, 12, 1)),
    "floor": (RefinementLevel(96, 8, 2), RefinementLevel(192, 16, 1)),
}
"""Levels while nothing changes: ``LOW``, then ``CONVERGED`` (about medium quality), in short
pieces, so that newer work does not wait."""

FIRST_AMBIENT = RefinementLevel(96, 4, 4)
FIRST_FLOOR = RefinementLevel(64, 1, 1)
FIRST_FLOOR_AMBIENT = RefinementLevel(64, 4, 4)
"""A light that does not move is traced once, so it may take longer."""
