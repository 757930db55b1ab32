"""Turntable: a drawing's relief swings from side to side, as clay and lit."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from scipy import ndimage

from ..camera import scene_in_view
from ..composite import composite
from ..drawing import Drawing
from ..pipeline import Pipeline
from ..prepared import PreparedDrawing
from ..render.passes import LightPasses, Passes
from ..render.request import frame_request
from ..scene import Material, Scene
from ..surface import Relief, visible_faces
from .left_out import warn_without_glows

FARTHEST = 40.0
"""Largest angle to either side, degrees."""
CLAY = 0.66
"""sRGB grey of the clay."""
PAPER = 226, 224, 219
_MARGIN = 1.08
_FINER = 2
"""Colours are sampled at this multiple of the size, so that lines and edges are smooth."""

Floats = NDArray[np.float32]
Picture = NDArray[np.uint8]


def swing(count: int) -> list[float]:
    """Angles in degrees of ``count`` pictures that loop, with slower motion at both ends."""
    # Rounded, so that both directions have the same angles.
    angles = (FARTHEST * math.sin(2 * math.pi * index / count) for index in range(count))
    return [round(angle, 3) + 0.0 for angle in angles]


def turn_table(
    pipeline: Pipeline,
    drawing: Drawing,
    prepared: PreparedDrawing,
    scene: Scene,
    count: int,
    size: int,
) -> Iterator[Picture]:
    """(h, w, 3) uint8 sRGB pictures of the turning relief: clay on the left, lit on the right.

    Args:
        prepared: from ``drawing``, in full detail.
        scene: in the drawing's pixels; lights do not move, and the floor is omitted. So is light
            that comes from surfaces, of which it warns.
        count: number of pictures in the loop. size: longest side of each half, pixels.

    Raises:
        RenderError: the renderer failed.
    """
    warn_without_glows(prepared, scene, "The turntable")
    scene = replace(scene, quality="medium", floor=None)
    long_side = max(int(np.ptp(np.flatnonzero(drawing.mask.any(axis=k)))) + 1 for k in (0, 1))
    stride = max(1, round(long_side / size))
    relief = prepared.relief(stride=stride, relief_scale=scene.relief_scale)
    surface = prepared.with_materials(relief, scene)
    middle = _middle(relief)
    turns = [_turned(relief.vertices, middle, angle) for angle in (-FARTHEST, 0, FARTHEST)]
    width, height = (2 * _MARGIN * max(float(abs(t[:, k]).max()) for t in turns) for k in (0, 1))
    scale = _FINER * size / max(width, height)
    columns, rows = (_FINER * max(1, round(scale * n / _FINER)) for n in (width, height))
    x, y = float(middle[0]), float(middle[1])
    camera = scale, 0.0, columns / 2 - scale * x, 0.0, scale, rows / 2 - scale * y
    placed = scene_in_view(scene, camera, (columns, rows))
    made: dict[float, Picture] = {}
    for angle in swing(count):
        if angle not in made:
            vertices = _turned(relief.vertices, middle, angle) * np.float32(scale)
            vertices[:, :2] += np.array([columns, rows], np.float32) / 2
            turned = Relief(vertices, relief.faces)
            view = _seen(prepared, relief, turned, (rows, columns))
            request = frame_request(view.size, replace(surface, relief=turned), placed)
            made[angle] = _picture(view, pipeline.renderer.render(request), placed)
        yield made[angle]


def _middle(relief: Relief) -> Floats:
    """(3,) the middle of the relief's bounding box."""
    low, high = relief.vertices.min(axis=0), relief.vertices.max(axis=0)
    middle: Floats = ((low + high) / 2).astype(np.float32)
    return middle


def _turned(vertices: Floats, middle: Floats, degrees: float) -> Floats:
    """``vertices`` rotated about the vertical axis through ``middle``, which becomes the origin. A
    positive angle turns the left side to the front."""
    x, y, z = (vertices - middle).T
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    turned: Floats = np.stack([cos * x + sin * z, y, cos * z - sin * x], axis=1, dtype=np.float32)
    return turned


def _seen(
    prepared: PreparedDrawing, relief: Relief, turned: Relief, size: tuple[int, int]
) -> Drawing:
    """The drawing projected onto the turned relief: every pixel, (rows, columns), shows the
    pixel of its body's drawing at the point where its ray meets the surface."""
    hit = visible_faces(turned.vertices, turned.faces, size)
    mask = hit.face >= 0
    u, v = hit.u[mask, None], hit.v[mask, None]
    faces = relief.faces[hit.face[mask]]
    corners = relief.vertices[faces, :2]
    x, y = ((1 - u - v) * corners[:, 0] + u * corners[:, 1] + v * corners[:, 2]).T - 0.5
    body = np.zeros(len(faces), np.int16) if relief.bodies is None else relief.bodies[faces[:, 0]]
    ink = np.zeros(size, np.float32)
    albedo, ink_colour = (np.zeros((*size, 3), np.float32) for _ in range(2))
    labels = np.full(size, -1, np.int16)
    parts = [(b.drawing.layers, b.left, b.top) for b in prepared.bodies]
    first = 0
    for index, (drawn, left, top) in enumerate(parts or [(prepared.layers, 0, 0)]):
        assert isinstance(drawn, Drawing)
        mine = np.zeros(size, bool)
        mine[mask] = body == index
        place = y[body == index] - top, x[body == index] - left
        for seen, layer in (
            (ink, drawn.ink),
            (albedo, drawn.albedo),
            (ink_colour, drawn.ink_colour),
        ):
            seen[mine] = _looked_up(layer, *place)
        row, column = (
            np.clip(np.rint(at).astype(np.intp), 0, side - 1)
            for at, side in zip(place, drawn.mask.shape, strict=True)
        )
        found = drawn.labels[row, column]
        labels[mine] = np.where(found >= 0, found + np.int16(first), found)
        first += len(drawn.palette.swatches)
    colour = albedo + ink[..., None] * (ink_colour - albedo)
    pixels = np.dstack([colour, mask.astype(np.float32)]) * 255
    whole = prepared.layers
    assert isinstance(whole, Drawing)
    return replace(
        whole,
        palette=prepared.palette,
        bodies=(),
        pixels=np.rint(pixels).astype(np.uint8),
        mask=mask,
        coverage=mask.astype(np.float32),
        lines=ink,
        ink=ink,
        ink_colour=ink_colour,
        albedo=albedo,
        labels=labels,
    )


def _looked_up(layer: Floats, y: NDArray[np.floating[Any]], x: NDArray[np.floating[Any]]) -> Floats:
    """(N, ...) the layer, (H, W, ...), at N places, bilinear."""
    planes = layer.reshape(*layer.shape[:2], -1)
    seen = np.empty((len(x), planes.shape[2]), np.float32)
    for index in range(planes.shape[2]):
        seen[:, index] = ndimage.map_coordinates(
            planes[..., index], [y, x], order=1, mode="nearest"
        )
    return seen.reshape(len(x), *layer.shape[2:])


def _picture(view: Drawing, passes: Passes, scene: Scene) -> Picture:
    """The clay and the lit drawing side by side, on white."""
    grey = np.full_like(view.albedo, CLAY) * view.mask[..., None]
    bare = replace(
        view,
        pixels=np.dstack([np.rint(grey * 255), view.mask * 255]).astype(np.uint8),
        ink=np.zeros_like(view.ink),
        albedo=grey,
    )
    white = tuple(replace(light, colour="#ffffff") for light in scene.lights)
    plain = replace(
        scene,
        lights=white,
        ambient=replace(scene.ambient, colour="#ffffff"),
        materials={},
        default_material=Material(),
    )
    colourless = Passes(tuple(map(_colourless, passes.lights)), _colourless(passes.ambient))
    halves = []
    for lit in (composite(bare, colourless, plain), composite(view, passes, scene)):
        paper = Image.new("RGBA", (lit.shape[1], lit.shape[0]), (*PAPER, 255))
        paper.alpha_composite(Image.fromarray(lit))
        halves.append(np.asarray(paper.convert("RGB").reduce(_FINER)))
    return np.concatenate(halves, axis=1)


def _colourless(light: LightPasses) -> LightPasses:
    """The surface in white, so that reflected light has no colour."""
    grey = light.diffuse.mean(axis=2, keepdims=True)
    return LightPasses(np.repeat(grey, 3, axis=2), light.glossy)
