"""Camera layers of Pencil2D: what each frame shows of the canvas, between two keys as well."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from ..camera import Affine
from .easing import LINEAR, eased
from .keyframes import following, held

Between = Literal["matrices", "parameters"]
"""What is interpolated between two keys: the entries of their matrices, as by Pencil2D 0.6, or
their place, angle and scale, as by 0.7."""


@dataclass(frozen=True)
class CameraKey:
    """The camera at a frame: drawings are moved by (dx, dy), rotated by ``turn`` degrees
    (clockwise) and then scaled, all about the picture's centre.

    Attributes:
        easing: number of the curve to the next key; see ``eased``.
        bend: (x, y) control point of a curved path to the next key, in the place of (dx, dy); None
            is a straight path.
    """

    frame: int
    dx: float = 0.0
    dy: float = 0.0
    turn: float = 0.0
    scale: float = 1.0
    easing: int = LINEAR
    bend: tuple[float, float] | None = None

    @cached_property
    def matrix(self) -> Affine:
        """From Pencil2D's frame to the picture's, both with their origins at the centre."""
        return _matrix(self.dx, self.dy, self.turn, self.scale)


@dataclass(frozen=True)
class Camera:
    """A camera with a view of ``width`` x ``height`` pixels."""

    name: str
    width: int
    height: int
    keys: tuple[CameraKey, ...]
    between: Between = "matrices"

    def at(self, frame: int) -> Affine:
        """From canvas to picture at ``frame``. The canvas is the view of a camera without keys."""
        across, down = self.width // 2, self.height // 2
        a, b, c, d, e, f = self._matrix(frame)
        # The centres of canvas and picture are both Pencil2D's origin.
        return (
            a, b, c + across - a * across - b * down,
            d, e, f + down - d * across - e * down,
        )  # fmt: skip

    def _matrix(self, frame: int) -> Affine:
        before = held(self.keys, frame)
        if before is None:
            return self.keys[0].matrix if self.keys else CameraKey(1).matrix
        after = following(self.keys, frame)
        if after is None:
            return before.matrix
        share = (frame - before.frame) / (after.frame - before.frame)
        return (_mixed if self.between == "matrices" else _moved)(before, after, share)


def _mixed(before: CameraKey, after: CameraKey, share: float) -> Affine:
    if before.matrix == after.matrix:
        return before.matrix
    a, b, c, d, e, f = (
        (1 - share) * one + share * other
        for one, other in zip(before.matrix, after.matrix, strict=True)
    )
    return a, b, c, d, e, f


def _moved(before: CameraKey, after: CameraKey, share: float) -> Affine:
    share = eased(before.easing, share)

    def mix(one: float, other: float) -> float:
        return one + share * (other - one)

    dx, dy = mix(before.dx, after.dx), mix(before.dy, after.dy)
    if before.bend is not None:  # a quadratic Bezier curve
        bend_x, bend_y = before.bend
        dx = mix(mix(before.dx, bend_x), mix(bend_x, after.dx))
        dy = mix(mix(before.dy, bend_y), mix(bend_y, after.dy))
    return _matrix(dx, dy, mix(before.turn, after.turn), mix(before.scale, after.scale))


def _matrix(dx: float, dy: float, turn: float, scale: float) -> Affine:
    cos, sin = scale * math.cos(math.radians(turn)), scale * math.sin(math.radians(turn))
    if turn % 360 == 0:
        cos, sin = scale, 0.0
    return cos, -sin, cos * dx - sin * dy, sin, cos, sin * dx + cos * dy
