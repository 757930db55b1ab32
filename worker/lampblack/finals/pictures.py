"""A shot of picture files; each is a cel without other layers."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..cache import digest
from ..camera import IDENTITY, Affine, on_canvas
from ..drawing import Frame, read_picture
from ..drawing.load import picture_bytes
from ..errors import DrawingError
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
        self._given = digest(self.mask, self.ink)
        self.frames = [
            ShotFrame(source.number, source.path.name, self._identity(source.path))
            for source in self.sources
        ]

    def cel(self, frame: ShotFrame) -> Cel:
        path = self._paths[frame.name]
        data = picture_bytes(path)
        if digest(self._given, data) != frame.drawing:
            raise DrawingError(
                f"{path} was changed while the shot was rendered.", "Render the shot again."
            )
        return Cel(read_picture(io.BytesIO(data), str(path)), self.mask, self.ink)

    def _identity(self, path: Path) -> str:
        """By the file's bytes, or by its name if it cannot be read: the error comes later."""
        try:
            return digest(self._given, picture_bytes(path))
        except DrawingError:
            return digest(self._given, bytes(path))

    def place(self, frame: ShotFrame, scene: Scene, size: tuple[int, int]) -> Scene:
        return on_canvas(scene, Canvas(*size))

    def camera(self, frame: ShotFrame) -> Affine:
        return IDENTITY

    def finish(self, frame: ShotFrame, lit: NDArray[Sample]) -> NDArray[Sample]:
        return lit
