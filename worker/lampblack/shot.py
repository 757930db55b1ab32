"""Shots: frames in order, each with a drawing to light and the layers around it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from .camera import Affine
from .scene import Canvas, Scene

Picture = NDArray[np.uint8]
Sample = TypeVar("Sample", np.uint8, np.float32)


@dataclass(frozen=True)
class Cel:
    """The drawing of a frame that is lit, in its own pixels.

    Attributes:
        pixels: (H, W, 4) uint8 sRGB, straight alpha.
        mask, ink: the artist's own, same shape, or None; see ``decompose_drawing``.
    """

    pixels: Picture
    mask: Picture | None = None
    ink: Picture | None = None


@dataclass(frozen=True)
class ShotFrame:
    """One frame of a shot.

    Attributes:
        number: the drawing's number; None if drawings are not numbered.
        name: the file's name with suffix.
        drawing: identifies the cel: frames with the same one are lit once.
        setting: identifies the layers around the cel, and the camera.
    """

    number: int | None
    name: str
    drawing: str
    setting: str = ""


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


def by_drawing(frames: Sequence[ShotFrame]) -> list[list[ShotFrame]]:
    """Frames grouped by drawing; groups and their frames keep their order."""
    groups: dict[str, list[ShotFrame]] = {}
    for frame in frames:
        groups.setdefault(frame.drawing, []).append(frame)
    return list(groups.values())
