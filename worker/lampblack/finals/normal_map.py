"""Normal maps as pictures, as game engines read them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..choices import Engine, NormalsAxis

FLAT = 128, 128, 255
"""A normal to the viewer."""


@dataclass(frozen=True)
class Habits:
    """Of an engine.

    Attributes:
        ending: of the names of normal maps. y: where green points.
        flat: whether normals are flat around the character, so that filters find nothing dark
            there.
    """

    ending: str = ""
    y: NormalsAxis = "up"
    flat: bool = True


_ENGINES: dict[Engine, Habits] = {
    "godot": Habits("_n"),
    "unity": Habits("_NormalMap"),
    "unreal": Habits("_N", "down"),
}


def engine_of(name: Engine | None) -> Habits:
    """The habits of an engine; without one, transparent pixels are black."""
    return Habits(flat=False) if name is None else _ENGINES[name]


def pointing(normals: NDArray[np.float32], y: NormalsAxis) -> NDArray[np.float32]:
    """Normals, (H, W, 3) with y up, with ``y`` where it is wanted."""
    return normals * np.array([1, 1 if y == "up" else -1, 1], np.float32)


def normal_map(
    normals: NDArray[np.float32], mask: NDArray[np.bool_], y: NormalsAxis, *, flat: bool
) -> NDArray[np.uint8]:
    """(H, W, 4) uint8: normals, (H, W, 3) with y up, with -1..1 as 0..255; transparent outside of
    ``mask``, and black there unless ``flat``."""
    colours = np.round((pointing(normals, y) * 0.5 + 0.5) * 255) * mask[..., None]
    picture = np.dstack([colours, mask * 255]).astype(np.uint8)
    if flat:
        picture[~mask, :3] = FLAT
    return picture
