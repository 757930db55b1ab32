"""How finely light is traced for a preview, step by step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

MISSING, PASSING, LOW, CONVERGED = -1, 0, 1, 2
"""How fine the light of a contribution is: none, traced while something changed, and the two
levels of ``REFINEMENT``."""


@dataclass(frozen=True)
class RefinementLevel:
    """Lighting pixels along the longer side, samples per pixel, and how many of these are traced
    before the tracer looks for newer work."""

    longest: int
    spp: int
    at_once: int


MOVING = (RefinementLevel(64, 1, 1), RefinementLevel(96, 1, 1), RefinementLevel(128, 1, 1))
"""For a light while something changes: the finest that keeps up is taken."""

REFINEMENT: dict[Literal["light", "ambient", "floor"], tuple[RefinementLevel, RefinementLevel]] = {
    "light": (RefinementLevel(192, 4, 2), RefinementLevel(384, 8, 1)),
    "ambient": (RefinementLevel(128, 8, 4), RefinementLevel(384, 12, 1)),
    "floor": (RefinementLevel(96, 8, 2), RefinementLevel(192, 16, 1)),
}
"""While nothing changes: ``LOW``, then ``CONVERGED`` (about medium quality), in pieces short
enough to be left."""

FIRST_AMBIENT = RefinementLevel(96, 4, 4)
FIRST_FLOOR = RefinementLevel(64, 1, 1)
FIRST_FLOOR_AMBIENT = RefinementLevel(64, 4, 4)
"""What is traced once may take longer than what moves."""
