"""Cameras: from the canvas, where the scene is defined, to the picture of a frame."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .looks import scaled_rim
from .scene import AreaLight, Canvas, DepthHint, DepthStroke, Drawn, Scene

Affine = tuple[float, float, float, float, float, float]
"""[a, b, c, d, e, f]: x' = a x + b y + c, y' = d x + e y + f, both in pixels, x right, y down."""
IDENTITY: Affine = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)

Sample = TypeVar("Sample", np.uint8, np.float32)
Stroke = TypeVar("Stroke", DepthHint, DepthStroke, Drawn)


def scene_in_view(scene: Scene, camera: Affine, size: tuple[int, int]) -> Scene:
    """``scene`` in the pixels of a drawing of ``size`` (width, height), seen through ``camera``."""
    if camera == IDENTITY:
        return on_canvas(scene, Canvas(*size))
    a, b, c, d, e, f = camera
    scale = math.sqrt(abs(a * e - b * d))
    width, height = (
        min(65536, max(1, round(side * scale)))
        for side in (scene.canvas.width, scene.canvas.height)
    )
    canvas = Canvas(width, height)

    def seen(light: AreaLight) -> AreaLight:
        x, y, right, down = light.x, light.y, c, f
        if light.kind == "sun":  # from the same side of the canvas, wherever that lies
            x, y = x - scene.canvas.width / 2, y - scene.canvas.height / 2
            right, down = width / 2, height / 2
        return replace(
            light,
            x=a * x + b * y + right,
            y=d * x + e * y + down,
            z=light.z * scale,
            size=max(1.0, light.size * scale),
        )

    floor = scene.floor
    if floor is not None:
        floor = replace(floor, y=d * scene.canvas.width / 2 + e * floor.y + f)
    lights = tuple(seen(light) for light in scene.lights)
    depth = replace(
        scene.depth,
        hints=tuple(hint_in_view(hint, camera) for hint in scene.depth.hints),
        strokes=tuple(hint_in_view(stroke, camera) for stroke in scene.depth.strokes),
    )
    rim = scaled_rim(scene.rim, scale)
    return replace(scene, canvas=canvas, lights=lights, floor=floor, depth=depth, rim=rim)


def on_canvas(scene: Scene, canvas: Canvas) -> Scene:
    """``scene`` on another canvas: all stays where it is, and suns shine from where they did."""
    right = (canvas.width - scene.canvas.width) / 2
    down = (canvas.height - scene.canvas.height) / 2
    lights = tuple(
        replace(light, x=light.x + right, y=light.y + down) if light.kind == "sun" else light
        for light in scene.lights
    )
    return replace(scene, canvas=canvas, lights=lights)


def box_on_canvas(
    box: tuple[float, float, float, float], camera: Affine
) -> tuple[float, float, float, float]:
    """The box on the canvas around what ``camera`` shows in ``box``; both x, y, width, height."""
    a, b, c, d, e, f = camera
    back = np.linalg.inv(np.array([[a, b], [d, e]]))
    x, y, width, height = box
    corners = np.array([(x + i * width, y + j * height) for i in (0, 1) for j in (0, 1)])
    places = (corners - [c, f]) @ back.T
    (left, top), (right, bottom) = places.min(axis=0).tolist(), places.max(axis=0).tolist()
    return left, top, right - left, bottom - top


def hint_in_view(hint: Stroke, camera: Affine) -> Stroke:
    """``hint`` seen through ``camera``; a mirroring camera also mirrors the sides of a stroke."""
    a, b, c, d, e, f = camera
    points = tuple(
        replace(p, x=a * p.x + b * p.y + c, y=d * p.x + e * p.y + f) for p in hint.points
    )
    scale = math.sqrt(abs(a * e - b * d))
    return hint.placed(points, scale, mirrored=a * e < b * d)


def is_flat(camera: Affine) -> bool:
    """Whether ``camera`` shows nothing, because it flattens the canvas to a line or a point."""
    a, b, _, d, e, _ = camera
    return abs(a * e - b * d) < 1e-6


def is_shift(camera: Affine) -> bool:
    """Whether ``camera`` only translates."""
    a, b, _, d, e, _ = camera
    return (a, b, d, e) == (1.0, 0.0, 0.0, 1.0)


def look_through(
    picture: NDArray[Sample], camera: Affine, size: tuple[int, int]
) -> NDArray[Sample]:
    """A picture seen through ``camera``, at ``size`` (width, height); empty past its edges.

    Bilinear. A camera that only translates moves by whole pixels, as Pencil2D's does.

    Args:
        picture: (H, W, C), with premultiplied alpha if it has alpha.
        camera: from the picture's pixels to those of the result.
    """
    width, height = size
    if is_shift(camera):
        return _shifted(picture, math.floor(camera[2] + 0.5), math.floor(camera[5] + 0.5), size)
    if is_flat(camera):
        return np.zeros((height, width, picture.shape[2]), picture.dtype)
    a, b, c, d, e, f = camera
    back = np.linalg.inv(np.array([[e, d], [b, a]]))
    # Pixel centres are at half coordinates, array indices at whole ones.
    start = back @ np.array([0.5 - f, 0.5 - c]) - 0.5
    seen = np.empty((height, width, picture.shape[2]), picture.dtype)
    for channel in range(picture.shape[2]):
        ndimage.affine_transform(
            picture[..., channel].astype(np.float32),
            back,
            start,
            output_shape=(height, width),
            output=(plane := np.zeros((height, width), np.float32)),
            order=1,
            mode="constant",
        )
        seen[..., channel] = np.rint(plane) if picture.dtype == np.uint8 else plane
    return seen


def _shifted(
    picture: NDArray[Sample], right: int, down: int, size: tuple[int, int]
) -> NDArray[Sample]:
    width, height = size
    if (right, down) == (0, 0) and picture.shape[:2] == (height, width):
        return picture
    seen = np.zeros((height, width, picture.shape[2]), picture.dtype)
    left, top = max(0, right), max(0, down)
    part = picture[max(0, -down) : max(0, height - down), max(0, -right) : max(0, width - right)]
    part = part[: max(0, height - top), : max(0, width - left)]
    seen[top : top + part.shape[0], left : left + part.shape[1]] = part
    return seen
