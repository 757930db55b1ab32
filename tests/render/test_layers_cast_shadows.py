"""An arm on a layer of its own, against two meshes of known shape in the same light."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import trimesh
from numpy.typing import NDArray

from lampblack.colour import linear
from lampblack.composite import composite
from lampblack.drawing import Drawing, decompose_cel, decompose_drawing
from lampblack.pipeline import Pipeline
from lampblack.render.request import Surface, frame_request
from lampblack.scene import Ambient, AreaLight, Scene, default_scene
from lampblack.surface import Relief
from support.drawings import draw_capsule, layered_cel

SIDE = 320
SIZE = SIDE, SIDE
MIDDLE, RADIUS = (160.0, 172.0), 104.0
SHOULDER, HAND, THICKNESS = (72.0, 156.0), (248.0, 156.0), 19.0
ORANGE, TAN = (200, 120, 70), (225, 170, 120)
BODY = draw_capsule(SIZE, MIDDLE, MIDDLE, RADIUS, ORANGE)
ARM = draw_capsule(SIZE, SHOULDER, HAND, THICKNESS, TAN)

Levels = NDArray[np.float64]


def from_above() -> Scene:
    light = AreaLight(x=MIDDLE[0], y=0, z=360, size=48, power=1.6)
    scene = default_scene(*SIZE)
    return replace(scene, lights=(light,), ambient=Ambient(strength=0.15), quality="medium")


def under_the_arm() -> NDArray[np.bool_]:
    """The part of the body below the arm, as deep as the arm is wide."""
    rows, columns = np.mgrid[:SIDE, :SIDE] + 0.5
    inside = np.hypot(columns - MIDDLE[0], rows - MIDDLE[1]) < RADIUS - 6
    start = HAND[1] + THICKNESS + 2
    return np.asarray(inside & (rows > start) & (rows < start + 2 * THICKNESS))


def level(lit: NDArray[np.uint8]) -> float:
    return float(linear(lit[..., :3] / 255).mean(axis=2)[under_the_arm()].mean())


def darker(lit: NDArray[np.uint8], alone: NDArray[np.uint8]) -> float:
    return 1 - level(lit) / level(alone)


def ball_mesh() -> trimesh.Trimesh:
    mesh = trimesh.creation.icosphere(subdivisions=5, radius=RADIUS - 1)
    mesh.apply_translation([*MIDDLE, 0])
    return mesh


def arm_mesh() -> trimesh.Trimesh:
    """A capsule that touches the ball."""
    mesh = trimesh.creation.capsule(height=HAND[0] - SHOULDER[0], radius=THICKNESS - 1)
    mesh.apply_translation(-mesh.bounds.mean(axis=0))
    mesh.apply_transform(trimesh.transformations.rotation_matrix(np.pi / 2, [0, 1, 0]))
    away = np.sqrt((RADIUS + THICKNESS) ** 2 - (HAND[1] - MIDDLE[1]) ** 2)
    mesh.apply_translation([(SHOULDER[0] + HAND[0]) / 2, HAND[1], away])
    return mesh


def meshes(*parts: tuple[trimesh.Trimesh, tuple[int, int, int]]) -> Surface:
    vertices = [np.asarray(mesh.vertices, np.float32) for mesh, _ in parts]
    starts = np.cumsum([0, *map(len, vertices)])
    # y goes down, so outside is to the other side.
    faces = [mesh.faces[:, ::-1] + start for (mesh, _), start in zip(parts, starts, strict=False)]
    albedo = [np.tile(linear(np.array(c) / 255), (len(mesh.vertices), 1)) for mesh, c in parts]
    count = int(starts[-1])
    return Surface(
        Relief(np.concatenate(vertices), np.concatenate(faces).astype(np.int32)),
        np.concatenate(albedo).astype(np.float32),
        np.zeros(count, np.float32),
        np.full(count, 0.5, np.float32),
    )


def test_an_arm_shades_the_body_as_two_meshes_would(pipeline: Pipeline) -> None:
    scene, cel = from_above(), layered_cel(body=BODY, arm=ARM)

    def traced(drawing: Drawing, surface: Surface) -> NDArray[np.uint8]:
        passes = pipeline.renderer.render(frame_request(SIZE, surface, scene))
        return composite(drawing, passes, scene)

    alone, joined = decompose_drawing(BODY), decompose_drawing(cel.pixels)
    bare = pipeline.render(alone, scene)
    layered = darker(pipeline.render(decompose_cel(cel), scene), bare)
    ball, both = (ball_mesh(), ORANGE), [(ball_mesh(), ORANGE), (arm_mesh(), TAN)]
    truth = darker(traced(joined, meshes(*both)), traced(alone, meshes(ball)))
    assert truth > 0.25
    assert layered > 0.25
    assert abs(layered - truth) < 0.05
    # Painted on one layer it is a decal.
    assert darker(pipeline.render(joined, scene), bare) < layered - 0.1


def test_the_arm_is_lit_and_its_line_is_the_artists_own(pipeline: Pipeline) -> None:
    cel = layered_cel(body=BODY, arm=ARM)
    lit = pipeline.render(decompose_cel(cel), from_above())
    assert np.array_equal(lit[..., 3], cel.pixels[..., 3])
    ink = (cel.pixels[..., :3] == [20, 16, 24]).all(axis=2) & (cel.pixels[..., 3] == 255)
    assert ink.sum() > 500
    assert np.abs(lit[ink].astype(int) - cel.pixels[ink]).max() <= 2
    middle = slice(int(HAND[1]) - 6, int(HAND[1]) + 6), slice(100, 220)
    shade = linear(lit[middle][..., :3] / 255) / linear(np.array(TAN) / 255)
    assert shade.mean() > 0.3
    assert shade.min() > 0.15  # no holes or leaks
