"""Shots: frames in order, each with a drawing to light and the layers around it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from .camera import Affine
from .scene import Canvas, Scene

Picture = NDArray[np.uint8]
Sample = TypeVar("Sample", np.uint8, np.float32)


MAX_LAYERS = 16
"""Layers of a cel that are kept apart. With more, the cel is lit as one body."""


@dataclass(frozen=True, eq=False)
class CelLayer:
    """One layer of a cel; what lies outside ``pixels`` is empty.

    Attributes:
        name: the artist's name of the layer; several layers may share one.
        pixels: (h, w, 4) uint8 sRGB, straight alpha.
        left, top: corner of ``pixels`` in the cel.
        line: whether the artist says that the layer holds nothing but line.
    """

    name: str
    pixels: Picture
    left: int = 0
    top: int = 0
    line: bool = False

    def placed(self, size: tuple[int, int]) -> Picture:
        """The layer in a cel of ``size`` (width, height): (H, W, 4) uint8."""
        height, width = self.pixels.shape[:2]
        if (width, height) == size:
            return self.pixels
        whole = np.zeros((size[1], size[0], 4), np.uint8)
        whole[self.top : self.top + height, self.left : self.left + width] = self.pixels
        return whole


def cropped_layer(name: str, picture: Picture, *, line: bool = False) -> CelLayer | None:
    """A layer without its empty margins; None if it is empty. ``picture`` is as large as the cel,
    (H, W, 4) uint8."""
    drawn = picture[..., 3] > 0
    rows, columns = np.flatnonzero(drawn.any(axis=1)), np.flatnonzero(drawn.any(axis=0))
    if not len(rows):
        return None
    top, left = int(rows[0]), int(columns[0])
    part = picture[top : int(rows[-1]) + 1, left : int(columns[-1]) + 1]
    return CelLayer(name, part.copy(), left, top, line)


@dataclass(frozen=True)
class Cel:
    """The drawing of a frame that is lit, in its own pixels.

    Attributes:
        pixels: (H, W, 4) uint8 sRGB, straight alpha.
        mask, ink: the artist's own, same shape, or None; see ``decompose_drawing``.
        light: (H, W, 4) uint8 sRGB, light that the artist painted, which is not in ``pixels``; None
            if there is none.
        layers: the layers that ``pixels`` was painted from, bottom first; none if there is only
            one, or they are not known.
    """

    pixels: Picture
    mask: Picture | None = None
    ink: Picture | None = None
    layers: tuple[CelLayer, ...] = ()
    light: Picture | None = None


@dataclass(frozen=True)
class ShotFrame:
    """One frame of a shot.

    Attributes:
        number: the drawing's number; None if drawings are not numbered.
        name: the file's name with suffix.
        drawing: identifies the cel: frames with the same one are lit once.
        setting: identifies the layers around the cel, and the camera.
        blank: nothing is drawn on the lit layers, on purpose: there is nothing to warn of.
    """

    number: int | None
    name: str
    drawing: str
    setting: str = ""
    blank: bool = False


class Shot(Protocol):
    """A source of frames: picture files, or a project."""

    @property
    def frames(self) -> Sequence[ShotFrame]:
        """All frames, in order."""

    @property
    def canvas(self) -> Canvas | None:
        """The canvas of this shot's scenes; None if each frame has its own size."""

    def cel(self, frame: ShotFrame) -> Cel:
        """The drawing of ``frame`` that is lit.

        Raises:
            DrawingError: it cannot be read.
        """

    def place(self, frame: ShotFrame, scene: Scene, size: tuple[int, int]) -> Scene:
        """``scene``, from the canvas to the pixels of the frame's cel of ``size`` (width,
        height)."""

    def camera(self, frame: ShotFrame) -> Affine:
        """From the cel's pixels to those of the finished frame."""

    def finish(self, frame: ShotFrame, lit: NDArray[Sample]) -> NDArray[Sample]:
        """The finished frame: the lit cel, (H, W, 4) sRGB with straight alpha (bytes, or 0 to 1),
        composited with the layers around it and seen through the camera."""


@dataclass(frozen=True)
class PictureLayer:
    """A layer that a program may show: its name, which no other one has, and whether the artist
    has left it visible."""

    name: str
    visible: bool


@dataclass(frozen=True)
class PaintedLayer:
    """What a layer shows in a frame.

    Attributes:
        identity: a digest of all that ``paint`` depends on.
        paint: makes the picture, (H, W, 4) uint8 sRGB with straight alpha.
    """

    name: str
    identity: str
    paint: Callable[[], Picture]


class LayeredShot(Protocol):
    """The frames of a drawing with their layers apart, as they are seen through the camera.

    Attributes:
        size: of the canvas, (width, height) pixels.
        numbers: of the frames, ascending.
        layers: all layers, bottom first.
    """

    size: tuple[int, int]
    fps: int
    numbers: Sequence[int]
    layers: Sequence[PictureLayer]

    def view(self, number: int) -> Affine:
        """From canvas to picture."""

    def painted(self, number: int) -> list[PaintedLayer]:
        """The layers of a frame that show something, bottom first.

        Raises:
            DrawingError: the frame cannot be read.
        """

    def whole(self, number: int) -> PaintedLayer | None:
        """All visible layers together; None if they are merely painted over each other."""


def by_number(frames: Sequence[ShotFrame]) -> dict[int, ShotFrame]:
    """Frames by number; one without a number is counted by its position."""
    return {
        index if frame.number is None else frame.number: frame
        for index, frame in enumerate(frames, start=1)
    }


def by_drawing(frames: Sequence[ShotFrame]) -> list[list[ShotFrame]]:
    """Frames grouped by drawing; groups and their frames keep their order."""
    groups: dict[str, list[ShotFrame]] = {}
    for frame in frames:
        groups.setdefault(frame.drawing, []).append(frame)
    return list(groups.values())
