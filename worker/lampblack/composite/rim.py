"""The rim: a band of light along the edges of the character."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..colour import hex_linear
from ..compiled import compiled
from ..scene import Scene
from .edges import reach_of
from .full_light import strongest_light
from .resample import Band

PLAIN_RIM = 0.25
"""Share of the rim's light that does not take the colour of the paint: dark cloth has a rim too."""
SOFT = 0.15
"""Half of the blend at the inner side of the band, as a share of its width."""

Bytes = NDArray[np.uint8]
Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class RimLight:
    """A scene's rim, ready to be shown.

    Attributes:
        width: of the band, in pixels of the drawing. colour: (3,) scene-linear.
        strength, away: see ``Rim``.
        key: (x, y) of the strongest light, in pixels of the drawing.
    """

    width: float
    colour: Floats
    strength: float
    away: float
    key: tuple[float, float]

    @staticmethod
    def of(scene: Scene) -> RimLight | None:
        """The rim of ``scene``; None if it has none."""
        rim = scene.rim
        if rim is None or not rim.strength:
            return None
        colour = hex_linear(rim.colour)
        return RimLight(rim.width, colour, rim.strength, rim.away, strongest_light(scene))


def rim_colour(rim: RimLight, albedo: Floats) -> Floats:
    """The colour of paint, (..., 3) scene-linear, in the rim's light: paler than the paint, and of
    its hue."""
    return np.asarray(rim.colour * (PLAIN_RIM + (1 - PLAIN_RIM) * np.sqrt(albedo)), np.float32)


def rim_shares(rim: RimLight, edges: Bytes, band: Band) -> Floats:
    """(rows, W) how much of the rim's light each pixel of ``band`` gets, 0 to 1.

    Args:
        edges: (H, W), see ``edge_distance``.
    """
    shares = np.empty((band.bottom - band.top, band.width), np.float32)
    _shares(
        edges, reach_of(edges.shape) / 255, rim.width, rim.strength, rim.away, *rim.key, band.top,
        shares,
    )  # fmt: skip
    return shares


@compiled
def rim_reach(unit: float, width: float, pixel: float) -> float:
    """The value in ``edges`` from which there is no rim; see ``rim_share``."""
    return float((width + max(SOFT * width, 0.9 * pixel)) / unit)


@compiled
def rim_share(
    edges: Any, row: int, column: int, unit: float, width: float, pixel: float, strength: float,
    away: float, right: float, down: float,
) -> Any:  # fmt: skip
    """The rim at a pixel of ``edges``, 0 to 1.

    Args:
        unit: pixels of the drawing for 1 in ``edges``. pixel: the same for one pixel.
        right, down: from the pixel to the strongest light, in the same direction as the columns
            and rows.
    """
    distance = edges[row, column] * unit
    soft = max(SOFT * width, 0.9 * pixel)
    share = (width - distance) / (2 * soft) + 0.5
    if share <= 0:
        return np.float32(0)
    share = min(share, 1.0)
    share = strength * share * share * (3 - 2 * share)
    if away > 0:
        # The edge of a drawing has steps of a pixel: seen from further away they even out.
        rows, columns = edges.shape
        step = 2 + int(0.75 * width / pixel)
        x0, x1 = max(column - step, 0), min(column + step, columns - 1)
        y0, y1 = max(row - step, 0), min(row + step, rows - 1)
        across = float(edges[row, x1]) - float(edges[row, x0])
        along = float(edges[y1, column]) - float(edges[y0, column])
        length = np.sqrt((across * across + along * along) * (right * right + down * down))
        facing = -(across * right + along * down) / max(length, 1e-6)
        lit = min(max((facing + 0.7) / 1.4, 0.0), 1.0)
        share *= 1 - away * lit * lit * (3 - 2 * lit)
    return np.float32(share)


@compiled
def _shares(
    edges: Any, unit: float, width: float, strength: float, away: float, x: float, y: float,
    top: int, shares: Any,
) -> None:  # fmt: skip
    for row in range(shares.shape[0]):
        for column in range(shares.shape[1]):
            shares[row, column] = rim_share(
                edges, top + row, column, unit, width, 1.0, strength, away,
                x - (column + 0.5), y - (top + row + 0.5),
            )  # fmt: skip
