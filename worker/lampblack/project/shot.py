"""A project as a shot: its lit layers are the cels, the others surround them.

Cels are painted on the canvas, not through the camera: a drawing that is held while the camera
moves is lit once, and its light does not swim.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..cache import digest
from ..camera import Affine, is_flat, look_through, on_canvas, scene_in_view
from ..choices import FrameLayers
from ..drawing.load import MAX_PIXELS, MAX_SIDE
from ..errors import LampblackWarning, ProjectError
from ..scene import Canvas, Scene
from ..shot import MAX_LAYERS, Cel, CelLayer, ShotFrame, cropped_layer
from .archive import Archive
from .camera_layer import Camera
from .document import Layer, Project
from .paint import LayerPainter, Picture
from .region import Region
from .stack import Roles, stack_layers
from .vector import VectorPictures

Sample = TypeVar("Sample", np.uint8, np.float32)


class ProjectShot:
    """The frames of a project, seen through one of its cameras.

    Args:
        roles: roles of layers by name; see ``stack_layers``.
        camera: the camera's name; None is the first camera.
        layers: that the frames show: all, or only the lit ones.

    Raises:
        ProjectError: there is nothing to light, no such camera, or its view is too large.
    """

    def __init__(
        self,
        project: Project,
        archive: Archive,
        roles: Roles,
        camera: str | None = None,
        layers: FrameLayers = "all",
    ) -> None:
        self._camera = _choose(project, camera)
        self.canvas = Canvas(self._camera.width, self._camera.height)
        self._stack = stack_layers(project, roles)
        if layers == "lit":
            self._stack = replace(self._stack, below=(), above=())
        self.region = _region(self._camera, project.length)
        origin = self._camera.width // 2, self._camera.height // 2
        self._painter = LayerPainter(archive, self.region, origin, VectorPictures(archive, origin))
        stem = Path(archive.path).stem
        self.frames: Sequence[ShotFrame] = [
            self._frame(number, stem) for number in range(1, project.length + 1)
        ]

    def _frame(self, number: int, stem: str) -> ShotFrame:
        stack, paint = self._stack, self._painter
        around = [paint.fingerprint(layers, number) for layers in (stack.below, stack.above)]
        lit = [paint.fingerprint(layers, number) for layers in (stack.lit, stack.line)]
        drawn = [layer for layer in stack.lit if _is_drawn(layer, number)]
        if stack.light:
            lit.append(paint.fingerprint(stack.light, number))
        named = [layer.name for layer in drawn]
        return ShotFrame(
            number,
            f"{stem}.{number:04d}.png",
            digest(*lit, *named) if len(named) > 1 else " ".join(lit),
            f"{around} {self._through(number)} {self.canvas}",
            blank=not drawn,
        )

    def cel(self, frame: ShotFrame) -> Cel:
        number = _number(frame)
        pixels = self._painter.paint(self._stack.lit, number)
        line = self._painter.paint(self._stack.line, number) if self._stack.line else None
        ink = line if line is not None and line[..., 3].any() else None
        light = self._painter.paint(self._stack.light, number) if self._stack.light else None
        return Cel(pixels, ink=ink, layers=self._layers(number), light=light)

    def _layers(self, number: int) -> tuple[CelLayer, ...]:
        """The lit layers apart, but for those that show nothing; one that touches up what is
        below belongs to it. None if there is only one, or more than ``MAX_LAYERS``."""
        bodies: list[list[Layer]] = []
        for layer in self._stack.lit:
            if bodies and layer.touches_up:
                bodies[-1].append(layer)
            elif _is_drawn(layer, number):
                bodies.append([layer])
        found: list[CelLayer] = []
        for first, *others in bodies if len(bodies) > 1 else []:
            picture = self._painter.paint([first, *others], number)
            drawn = cropped_layer(first.name, picture, line=first in self._stack.line)
            found += [] if drawn is None else [drawn]
            if len(found) > MAX_LAYERS:
                return ()
        return tuple(found) if len(found) > 1 else ()

    def place(self, frame: ShotFrame, scene: Scene, size: tuple[int, int]) -> Scene:
        scene = on_canvas(scene, self.canvas)
        if self.region == Region(0, 0, self.canvas.width, self.canvas.height):
            return scene
        left, top, scale = self.region.left, self.region.top, self.region.scale
        return scene_in_view(scene, (scale, 0.0, -left, 0.0, scale, -top), size)

    def camera(self, frame: ShotFrame) -> Affine:
        return self._through(_number(frame))

    def finish(self, frame: ShotFrame, lit: NDArray[Sample]) -> NDArray[Sample]:
        """Layers are composited as in Pencil2D. Without other layers, and under a camera that only
        translates, this is the lit cel itself."""
        number = _number(frame)
        size = self.canvas.width, self.canvas.height
        camera = self.camera(frame)
        below = self._painter.paint(self._stack.below, number) if self._stack.below else None
        above = self._painter.paint(self._stack.above, number) if self._stack.above else None
        if below is None and above is None and camera[:2] + camera[3:5] == (1.0, 0.0, 0.0, 1.0):
            return look_through(lit, camera, size)
        layered = _premultiplied(lit)
        if below is not None:
            layered = _over(layered, _premultiplied(below))
        if above is not None:
            layered = _over(_premultiplied(above), layered)
        seen = _straight(look_through(layered, camera, size))
        return (np.rint(seen * 255) if lit.dtype == np.uint8 else seen).astype(lit.dtype)

    def _through(self, number: int) -> Affine:
        """From the region's pixels to the picture's."""
        a, b, c, d, e, f = self._camera.at(number)
        a, b, d, e = (each / self.region.scale for each in (a, b, d, e))
        left, top = self.region.left, self.region.top
        return a, b, c + a * left + b * top, d, e, f + d * left + e * top


def _is_drawn(layer: Layer, frame: int) -> bool:
    key = layer.key_at(frame)
    return key is not None and not key.blank


def _choose(project: Project, name: str | None) -> Camera:
    for camera in project.cameras:
        if name in (None, camera.name):
            return camera
    raise ProjectError(
        f"The project has no camera {name!r}.",
        f"It has {', '.join(repr(camera.name) for camera in project.cameras)}.",
    )


def _region(camera: Camera, length: int) -> Region:
    """The part of the canvas that the camera sees, over all frames. Where it shows the canvas at
    half size or smaller in every frame, no more is painted than that."""
    low, high = np.full(2, math.inf), np.full(2, -math.inf)
    corners = np.array([[0, 0], [1, 0], [0, 1], [1, 1]]) * [camera.width, camera.height]
    closest = 0.0
    for matrix in {camera.at(number) for number in range(1, length + 1)}:
        a, b, c, d, e, f = matrix
        if is_flat(matrix):
            continue
        closest = max(closest, math.sqrt(abs(a * e - b * d)))
        seen = (corners - [c, f]) @ np.linalg.inv(np.array([[a, b], [d, e]])).T
        low, high = np.minimum(low, seen.min(axis=0)), np.maximum(high, seen.max(axis=0))
    if not closest:
        raise ProjectError("The camera shows nothing in any frame.", "Move its keys apart.")
    finest = closest if closest <= 0.5 else 1.0
    extent = high - low
    scale = min(finest, MAX_SIDE / extent.max(), math.sqrt(MAX_PIXELS / extent.prod()))
    if scale < finest:
        scale *= 0.999  # leaves room for rounding up
        warnings.warn(
            f"The camera sees {extent[0]:.0f} x {extent[1]:.0f} pixels of the canvas over all "
            f"frames; they are lit at {100 * scale:.0f} % of their size. It is less when the "
            "camera moves less.",
            LampblackWarning,
            stacklevel=3,
        )
    # Pixels that are those of a still camera's picture are not resampled again.
    left, top = np.floor(low + 1e-6) if scale == 1 else low * scale
    width, height = np.ceil(high * scale - (left, top) - 1e-6).astype(int)
    return Region(float(left), float(top), int(width), int(height), float(scale))


def _number(frame: ShotFrame) -> int:
    assert frame.number is not None
    return frame.number


def _premultiplied(picture: Picture | NDArray[np.float32]) -> NDArray[np.float32]:
    """(H, W, 4) straight alpha, bytes or 0 to 1, to premultiplied 0 to 1."""
    most = 255 if picture.dtype == np.uint8 else 1
    layered = np.divide(picture, most, dtype=np.float32)
    layered[..., :3] *= layered[..., 3:]
    return layered


def _over(top: NDArray[np.float32], bottom: NDArray[np.float32]) -> NDArray[np.float32]:
    return top + (1 - top[..., 3:]) * bottom


def _straight(layered: NDArray[np.float32]) -> NDArray[np.float32]:
    colour = layered[..., :3] / np.maximum(layered[..., 3:], 1e-6)
    picture: NDArray[np.float32] = np.concatenate([colour, layered[..., 3:]], axis=2)
    return np.clip(picture, 0, 1)
