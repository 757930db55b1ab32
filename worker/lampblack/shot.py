"""A shot: frames in order, each with a drawing that is lit and what surrounds it."""

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
    """What of a frame is lit, in pixels of its own.

    Attributes:
        pixels: (H, W, 4) uint8 sRGB, straight alpha.
        mask, ink: the artist's own, pictures of the same size, or None; see ``decompose_drawing``.
    """

    pixels: Picture
    mask: Picture | None = None
    ink: Picture | None = None


@dataclass(frozen=True)
class ShotFrame:
    """One frame of a shot.

    Attributes:
        number: as the drawings are numbered; None if they are not.
        name: of its file, with suffix.
        drawing: names its cel: frames that are alike here are lit once.
        setting: names what surrounds the cel.
    """

    number: int | None
    name: str
    drawing: str
    setting: str = ""


class Shot(Protocol):
    """Where frames come from: picture files, or a project."""

    @property
    def frames(self) -> Sequence[ShotFrame]:
        """In order."""

    @property
    def canvas(self) -> Canvas | None:
        """What scenes for this shot are measured in; None if each frame has its own size."""

    def cel(self, frame: ShotFrame) -> Cel:
        """The drawing that is lit.

        Raises:
            DrawingError: it cannot be read.
        """

    def place(self, scene: Scene, size: tuple[int, int]) -> Scene:
        """``scene``, made for the canvas, in the pixels of a cel of ``size`` (width, height)."""

    def camera(self, frame: ShotFrame) -> Affine:
        """The cel's pixels to those of the finished frame."""

    def finish(self, frame: ShotFrame, lit: NDArray[Sample]) -> NDArray[Sample]:
        """The lit cel, (H, W, 4) sRGB with straight alpha (bytes, or 0 to 1), as the camera sees
        it among what surrounds it."""


def by_drawing(frames: Sequence[ShotFrame]) -> list[list[ShotFrame]]:
    """Frames that share a drawing, together; groups and their frames keep their order."""
    groups: dict[str, list[ShotFrame]] = {}
    for frame in frames:
        groups.setdefault(frame.drawing, []).append(frame)
    return list(groups.values())
