"""A shot of picture files; each is a cel without other layers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..cache import digest
from ..camera import IDENTITY, Affine, on_canvas
from ..drawing import Frame, load_picture
from ..scene import Canvas, Scene
from ..shot import Cel, Picture, ShotFrame

Sample = TypeVar("Sample", np.uint8, np.float32)


@dataclass
class PictureShot:
    """PNG files; ``mask`` and ``ink`` are used for all of them."""

    sources: Sequence[Frame]
    mask: Picture | None = None
    ink: Picture | None = None
    frames: Sequence[ShotFrame] = field(init=False)
    canvas: Canvas | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        self._paths = {source.path.name: source.path for source in self.sources}
        given = digest(self.mask, self.ink)
        self.frames = [
            ShotFrame(source.number, source.path.name, digest(given, _content(source.path)))
            for source in self.sources
        ]

    def cel(self, frame: ShotFrame) -> Cel:
        return Cel(load_picture(self._paths[frame.name]), self.mask, self.ink)

    def place(self, frame: ShotFrame, scene: Scene, size: tuple[int, int]) -> Scene:
        return on_canvas(scene, Canvas(*size))

    def camera(self, frame: ShotFrame) -> Affine:
        return IDENTITY

    def finish(self, frame: ShotFrame, lit: NDArray[Sample]) -> NDArray[Sample]:
        return lit


def _content(path: Path) -> bytes:
    """A digest of the file's bytes, or of its name if it cannot be read; the error comes later."""
    try:
        return path.read_bytes()
    except OSError:
        return bytes(path)
