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

from ..camera import Affine, is_flat, is_shift, look_through, on_canvas, scene_in_view
from ..choices import FrameLayers
from ..drawing.load import MAX_PIXELS, MAX_SIDE
from ..errors import LampblackWarning, ProjectError
from ..scene import Canvas, Scene
from ..shot import MAX_LAYERS, Cel, CelLayer, ShotFrame, cropped_layer
from .archive import Archive
from .camera_layer import Camera
from .document import Layer, Project
from .exposure_sheet import shown
from .layer_pictures import LayerPictures, Picture
from .paint import LayerPainter
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
        self.fps = project.fps
        self._stack = stack_layers(project, roles)
        if layers == "lit":
            self._stack = replace(self._stack, below=(), above=())
        self._views = [self._camera.at(number) for number in range(1, project.length + 1)]
        self.region = seen_region(self._camera, self._views)
        origin = self._camera.width // 2, self._camera.height // 2
        vectors = VectorPictures(archive, origin)
        self._painter = LayerPainter(LayerPictures(archive, self.region, origin, vectors))
        self.frames: Sequence[ShotFrame] = self._frames(project.length, Path(archive.path).stem)

    def _frames(self, length: int, stem: str) -> list[ShotFrame]:
        stack, identify = self._stack, self._painter.identity
        lit = shown(stack.lit, length, identify)
        # What the layers are called tells several bodies apart, and nothing else.
        named = shown(stack.lit, length, lambda layer, key: layer.name.encode(errors="replace"))
        others = [
            shown(layers, length, identify)
            for layers in (stack.line, stack.light, stack.below, stack.above)
        ]
        frames: list[ShotFrame] = []
        for number, (cel, names, line, light, below, above) in enumerate(
            zip(lit, named, *others, strict=True), start=1
        ):
            own = [cel, line, light, *([names] if cel.drawn > 1 else [])]
            frames.append(
                ShotFrame(
                    number,
                    f"{stem}.{number:04d}.png",
                    " ".join(each.identity for each in own),
                    f"{below.identity} {above.identity} {self._through(number)} {self.canvas}",
                    blank=not cel.drawn,
                )
            )
        return frames

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
        """Layers are composited as in their own program. Without other layers, and under a camera
        that only translates, this is the lit cel itself."""
        number = _number(frame)
        size = self.canvas.width, self.canvas.height
        camera = self.camera(frame)
        below = self._painter.paint(self._stack.below, number) if self._stack.below else None
        above = self._stack.above
        if below is None and not above and camera[:2] + camera[3:5] == (1.0, 0.0, 0.0, 1.0):
            return look_through(lit, camera, size)
        layered = _premultiplied(lit)
        if below is not None:
            layered = _over(layered, _premultiplied(below))
        if any(layer.touches_up for layer in above):
            layered = _premultiplied(self._painter.paint_on(_straight(layered), above, number))
        elif above:
            layered = _over(_premultiplied(self._painter.paint(above, number)), layered)
        seen = _straight(look_through(layered, camera, size))
        return (np.rint(seen * 255) if lit.dtype == np.uint8 else seen).astype(lit.dtype)

    def _through(self, number: int) -> Affine:
        return self.region.through(self._views[number - 1])


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


def seen_region(camera: Camera, views: Sequence[Affine]) -> Region:
    """The part of the canvas that the camera sees, over all frames. Where it shows the canvas at
    half size or smaller in every frame, no more is painted than that."""
    corners = np.array([[0, 0], [1, 0], [0, 1], [1, 1]]) * [camera.width, camera.height]
    matrices = np.array([view for view in set(views) if not is_flat(view)]).reshape(-1, 2, 3)
    if not len(matrices):
        raise ProjectError("The camera shows nothing in any frame.", "Move its keys apart.")
    turns, moves = matrices[:, :, :2], matrices[:, None, :, 2]
    closest = math.sqrt(np.abs(np.linalg.det(turns)).max())
    seen = (corners - moves) @ np.linalg.inv(turns).transpose(0, 2, 1)
    low, high = seen.min(axis=(0, 1)), seen.max(axis=(0, 1))
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


def picture_through(picture: Picture, camera: Affine, size: tuple[int, int]) -> Picture:
    """A picture with straight alpha, (H, W, 4) uint8 sRGB, seen through ``camera``."""
    if is_shift(camera):
        return look_through(picture, camera, size)
    seen = _straight(look_through(_premultiplied(picture), camera, size))
    return np.asarray(np.rint(seen * 255), np.uint8)


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
