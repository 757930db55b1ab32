"""The lamplighter's model sheet: its colours, and what changes from drawing to drawing."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from strokes import Points

INK = "#2a1a22"
FUR = "#4f8fb3"
CREAM = "#f6e5c0"
SCARF = "#dd3f2e"
STRIPE = "#9c2532"
BRASS = "#e3a62f"
GLASS = "#fff0a3"
FLAME = "#ff9636"
BOOTS = "#94491f"
SOLES = "#cf9758"
HAT = "#2f8062"
PINK = "#f09a8a"
WHITE = "#fffdf5"
BLACK = "#12111a"
COLOURS = (
    INK, FUR, CREAM, SCARF, STRIPE, BRASS, GLASS, FLAME, BOOTS, SOLES, HAT, PINK, WHITE, BLACK,
)  # fmt: skip


@dataclass(frozen=True)
class Foot:
    """Where a boot stands relative to its rest, and how far its toe points down, degrees."""

    x: float = 0.0
    y: float = 0.0
    turn: float = 0.0


@dataclass(frozen=True)
class Pose:
    """What changes from drawing to drawing; the default is the still.

    Angles are degrees clockwise from pointing right; arms are (upper, lower).
    """

    hop: float = 0.0
    squash: float = 1.0
    lean: float = 0.0
    lantern_arm: tuple[float, float] = (188.0, 229.0)
    free_arm: tuple[float, float] = (31.0, 152.0)
    paw_turn: float = 0.0
    palm_out: bool = False
    swing: float = 4.0
    tail: float = 0.0
    scarf: float = 0.0
    gaze: tuple[float, float] = (-9.0, 5.0)
    eyes_shut: bool = False
    smile: float = 1.0
    hat_lift: float = 0.0
    feet: tuple[Foot, Foot] = (Foot(), Foot())

    @property
    def stretch(self) -> tuple[float, float]:
        """Scale along x and y: what is lost in height is gained in girth."""
        return self.squash**-0.75, self.squash

    def bend(self, points: Points) -> Points:
        """Squash about the floor, lean more the higher up, and lift off."""
        x, y = points[:, 0] * self.stretch[0], points[:, 1] * self.stretch[1]
        return np.column_stack([x + self.lean * (y / 800) ** 2, y - self.hop])
