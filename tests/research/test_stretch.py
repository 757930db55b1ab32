"""Stretched characters: their normals are those of the stretched body."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from lampblack_research.training.stretch import linear_stretch, random_stretch, stretched

Image = NDArray[np.float32]


def ball(size: int, radius: float) -> Image:
    """(size, size, 5): normals and coverage of a sphere, and its coverage once more."""
    rows, columns = np.mgrid[0:size, 0:size] + 0.5 - size / 2
    x, y = columns / radius, -rows / radius
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    mask = np.hypot(x, y) < 1
    planes: Image = np.where(mask[..., None], np.stack([x, y, z, mask, mask], axis=2), 0)
    return planes.astype(np.float32)


@pytest.mark.parametrize("seed", range(5))
def test_a_stretched_sphere_is_an_ellipsoid(seed: int) -> None:
    matrix = random_stretch(np.random.default_rng(seed)).matrix @ np.diag([1.3, 1 / 1.3])
    found = stretched(ball(240, 100.0), linear_stretch(matrix))
    height, width = found.shape[:2]
    rows, columns = np.mgrid[0:height, 0:width] + 0.5
    place = np.stack([columns - width / 2, height / 2 - rows], axis=2) / 100
    back = np.linalg.inv(matrix)
    on_ball = place @ back.T
    z = np.sqrt(np.maximum(1 - np.square(on_ball).sum(axis=2, keepdims=True), 0))
    truth = np.concatenate([on_ball @ back, z], axis=2)
    truth /= np.maximum(np.linalg.norm(truth, axis=2, keepdims=True), 1e-9)
    inside = np.hypot(*on_ball.transpose(2, 0, 1)) < 0.95
    angle = np.degrees(np.arccos(np.clip((found[..., :3] * truth).sum(axis=2), -1, 1)))
    assert angle[inside].max() < 1.0
    assert np.abs(np.linalg.norm(found[..., :3], axis=2)[inside] - 1).max() < 0.01
    # No plane has moved against another, and the area has stayed.
    assert np.array_equal(found[..., 3], found[..., 4])
    assert found[..., 3].sum() == pytest.approx(np.pi * 100**2, rel=0.01)
    assert (found[..., 3] > 0.5)[inside].all()
    assert not (found[..., 3] > 0.5)[np.hypot(*on_ball.transpose(2, 0, 1)) > 1.03].any()


@pytest.mark.parametrize("seed", range(5))
def test_normals_of_a_bent_sphere_are_those_of_its_depth(seed: int) -> None:
    bend = random_stretch(np.random.default_rng(seed))
    size, radius = 240, 100.0
    picture = ball(size, radius)
    rows, columns = np.mgrid[0:size, 0:size] + 0.5 - size / 2
    picture[..., 4] = np.sqrt(np.maximum(radius**2 - rows**2 - columns**2, 0))
    found = stretched(picture, bend)
    down, right = np.gradient(found[..., 4])
    truth = np.stack([-right, down, np.ones_like(down)], axis=2)
    truth /= np.linalg.norm(truth, axis=2, keepdims=True)
    inside = found[..., 4] > 0.5 * radius
    angle = np.degrees(np.arccos(np.clip((found[..., :3] * truth).sum(axis=2), -1, 1)))
    assert angle[inside].max() < 1.0
    assert (found[[0, -1]] == 0).all()
    assert (found[:, [0, -1]] == 0).all()
    assert found[..., 3].sum() == pytest.approx(np.pi * radius**2, rel=0.1)


def test_no_stretch_changes_nothing_and_a_turn_turns_the_normals() -> None:
    picture = ball(120, 50.0)
    picture[20:40, 70:80, 4] = 0.5
    assert np.allclose(stretched(picture, linear_stretch(np.eye(2))), picture, atol=1e-3)
    turned = stretched(
        picture, linear_stretch(np.array([[0.0, -1.0], [1.0, 0.0]]))
    )  # anticlockwise
    expected = np.rot90(picture).copy()
    expected[..., :2] = np.stack([-expected[..., 1], expected[..., 0]], axis=2)
    assert np.allclose(turned, expected, atol=1e-3)


def test_stretches_differ_and_keep_the_area() -> None:
    maps = [random_stretch(np.random.default_rng(seed)).matrix for seed in range(200)]
    assert np.allclose([np.linalg.det(m) for m in maps], 1)
    longest = [np.linalg.svd(m, compute_uv=False)[0] for m in maps]
    assert 1.1 < np.median(longest) < 1.25
    assert ndimage.variance([m[0, 1] - m[1, 0] for m in maps]) > 0.05
