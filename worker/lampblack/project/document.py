"""The description of a Pencil2D project: layers, their keyframes, and cameras.

Pencil2D's frame of reference: x right, y *down*, with the origin at the centre of the view of a
camera that has not moved. Frames count from 1. A keyframe holds until the
next one; it may come before frame 1.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeVar

from ..camera import Affine
from .blend import Blend

Kind = Literal["bitmap", "vector"]


@dataclass(frozen=True)
class Key:
    """A drawing on a layer.

    Attributes:
        file: name in the project's data folder; empty for a blank drawing.
        left, top: position of a bitmap's top left corner.
        opacity: 0 to 1.
        inline: XML of a vector drawing that is in the description itself, as Pencil 0.4 wrote it.
    """

    frame: int
    file: str
    left: int = 0
    top: int = 0
    opacity: float = 1.0
    inline: bytes = b""

    @property
    def blank(self) -> bool:
        """Whether nothing is drawn."""
        return not self.file and not self.inline


@dataclass(frozen=True)
class Group:
    """Layers that are painted together on nothing, and then blended with what is below."""

    number: int
    opacity: float = 1.0
    blend: Blend = "normal"


@dataclass(frozen=True)
class Layer:
    """A layer of drawings; ``keys`` by frame. Hidden layers are not shown.

    Attributes:
        blend: how it is blended with what is below.
        clipped: it shows only where what is below is.
        groups: the groups that it is in, outermost first.
    """

    number: int
    name: str
    kind: Kind
    visible: bool
    keys: tuple[Key, ...]
    blend: Blend = "normal"
    clipped: bool = False
    groups: tuple[Group, ...] = ()

    @property
    def touches_up(self) -> bool:
        """Whether it changes what is below rather than covering it."""
        return self.clipped or self.blend != "normal"

    def key_at(self, frame: int) -> Key | None:
        """The drawing that ``frame`` shows; None before the first key."""
        return _held(self.keys, frame)


@dataclass(frozen=True)
class CameraKey:
    """The camera at a frame: drawings are moved by (dx, dy), rotated by ``turn`` degrees
    (clockwise) and then scaled, all about the picture's centre."""

    frame: int
    dx: float = 0.0
    dy: float = 0.0
    turn: float = 0.0
    scale: float = 1.0

    @property
    def matrix(self) -> Affine:
        """From Pencil2D's frame to the picture's, both with their origins at the centre."""
        cos = self.scale * math.cos(math.radians(self.turn))
        sin = self.scale * math.sin(math.radians(self.turn))
        if self.turn % 360 == 0:
            cos, sin = self.scale, 0.0
        return (
            cos, -sin, cos * self.dx - sin * self.dy,
            sin, cos, sin * self.dx + cos * self.dy,
        )  # fmt: skip


@dataclass(frozen=True)
class Camera:
    """A camera with a view of ``width`` x ``height`` pixels."""

    name: str
    width: int
    height: int
    keys: tuple[CameraKey, ...]

    def at(self, frame: int) -> Affine:
        """From canvas to picture at ``frame``. The canvas is the view of a camera without keys.

        Between two keys the matrices are interpolated linearly, as in Pencil2D 0.6.
        """
        across, down = self.width // 2, self.height // 2
        a, b, c, d, e, f = self._matrix(frame)
        # The centres of canvas and picture are both Pencil2D's origin.
        return (
            a, b, c + across - a * across - b * down,
            d, e, f + down - d * across - e * down,
        )  # fmt: skip

    def _matrix(self, frame: int) -> Affine:
        before = _held(self.keys, frame)
        if before is None:
            return self.keys[0].matrix if self.keys else CameraKey(1).matrix
        after = next((key for key in self.keys if key.frame > frame), before)
        if after is before or before == CameraKey(before.frame, *_place(after)):
            return before.matrix
        share = (frame - before.frame) / (after.frame - before.frame)
        mixed = [
            (1 - share) * one + share * other
            for one, other in zip(before.matrix, after.matrix, strict=True)
        ]
        return (mixed[0], mixed[1], mixed[2], mixed[3], mixed[4], mixed[5])


@dataclass(frozen=True)
class Project:
    """A project without its pictures.

    Attributes:
        layers: layers of drawings, bottom first.
        cameras: in the project's order.
        length: number of the last frame.
        fps: frames per second.
    """

    layers: tuple[Layer, ...]
    cameras: tuple[Camera, ...]
    length: int
    fps: int


_Keyed = TypeVar("_Keyed", Key, CameraKey)


def _held(keys: Sequence[_Keyed], frame: int) -> _Keyed | None:
    index = bisect_right(keys, frame, key=lambda key: key.frame)
    return keys[index - 1] if index else None


def _place(key: CameraKey) -> tuple[float, float, float, float]:
    return key.dx, key.dy, key.turn, key.scale
