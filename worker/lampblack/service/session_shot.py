"""The announced frames of a client, as a shot."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from numpy.typing import NDArray

from ..camera import IDENTITY, Affine, scene_in_view
from ..drawing import DrawingPlanes
from ..scene import Canvas, Scene
from ..shot import Cel, Sample, ShotFrame
from .session import FrameContent


class SessionShot:
    """Frames as the client sees them: each drawing is lit in its own view, which is the finished
    frame.

    Args:
        contents: content of each frame of the animation.
        canvas: the scene's canvas.
        output: pattern with ``%04d`` for the names of the frames.
        planes: returns a drawing by its digest, or raises LampblackError.
    """

    def __init__(
        self,
        contents: Mapping[int, FrameContent],
        canvas: Canvas,
        output: str,
        planes: Callable[[str], DrawingPlanes],
    ) -> None:
        self._contents = dict(contents)
        self._planes = planes
        self.canvas: Canvas | None = canvas
        self.frames = [
            ShotFrame(number, Path(output % number).name, content.digest, repr(content.camera))
            for number, content in sorted(contents.items())
        ]

    def cel(self, frame: ShotFrame) -> Cel:
        planes = self._planes(frame.drawing)
        mask, ink = planes.pictures
        return Cel(planes.pixels, mask, ink, planes.layers, planes.light)

    def place(self, frame: ShotFrame, scene: Scene, size: tuple[int, int]) -> Scene:
        assert frame.number is not None
        return scene_in_view(scene, self._contents[frame.number].camera, size)

    def camera(self, frame: ShotFrame) -> Affine:
        return IDENTITY

    def finish(self, frame: ShotFrame, lit: NDArray[Sample]) -> NDArray[Sample]:
        return lit
