"""A shot of drawings with layers: each file is one frame."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..cache import digest
from ..camera import Affine
from ..choices import FrameLayers, LayerRole
from ..drawing import Frame
from ..errors import LampblackWarning, ProjectError
from ..files import read_bounded
from ..project import read_project
from ..project.shot import ProjectShot
from ..scene import Canvas, Scene
from ..shot import Cel, ShotFrame

Sample = TypeVar("Sample", np.uint8, np.float32)
MAX_BYTES = 1 << 30
"""Of one file."""
_OPEN = 2
"""Files that are kept open: that of the frame at hand, and the next one, which is read ahead."""


@dataclass
class LayeredSequence:
    """Files of OpenRaster, Photoshop or Krita.

    Attributes:
        roles: roles of layers by name, in all files; see ``stack_layers``.
        layers: that the frames show: all, or only the lit ones.
    """

    sources: Sequence[Frame]
    roles: Mapping[str, LayerRole]
    layers: FrameLayers = "all"
    frames: Sequence[ShotFrame] = field(init=False)
    canvas: Canvas | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        self._paths = {source.path.name: source.path for source in self.sources}
        self._opened = lru_cache(_OPEN)(self._open)
        self.frames = [
            ShotFrame(source.number, source.path.name, self._identity(source.path))
            for source in self.sources
        ]

    def cel(self, frame: ShotFrame) -> Cel:
        shot = self._opened(frame)
        return shot.cel(shot.frames[0])

    def place(self, frame: ShotFrame, scene: Scene, size: tuple[int, int]) -> Scene:
        shot = self._opened(frame)
        return shot.place(shot.frames[0], scene, size)

    def camera(self, frame: ShotFrame) -> Affine:
        shot = self._opened(frame)
        return shot.camera(shot.frames[0])

    def finish(self, frame: ShotFrame, lit: NDArray[Sample]) -> NDArray[Sample]:
        shot = self._opened(frame)
        return shot.finish(shot.frames[0], lit)

    def _open(self, frame: ShotFrame) -> ProjectShot:
        path = self._paths[frame.name]
        shot = ProjectShot(*read_project(path), self.roles, layers=self.layers)
        if self._identity(path) != frame.drawing:
            raise ProjectError(
                f"{path} was changed while the shot was rendered.", "Render the shot again."
            )
        if len(shot.frames) > 1:
            warnings.warn(
                f"{path} holds {len(shot.frames)} frames; only the first is used. Render the file "
                "on its own to light all of them.",
                LampblackWarning,
                stacklevel=2,
            )
        return shot

    def _identity(self, path: Path) -> str:
        """By the file's bytes, or by its name if it cannot be read: the error comes later."""
        given = sorted(self.roles.items()), self.layers
        try:
            return digest(given, read_bounded(path, MAX_BYTES))
        except OSError:
            return digest(given, bytes(path))
