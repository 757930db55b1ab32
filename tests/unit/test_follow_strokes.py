"""Normals that follow the artist's strokes of round and hollow parts."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.normals.bend_strokes import HOLLOW, ROUND, BendStroke
from lampblack.normals.follow_strokes import TILT, divergence, follow_strokes

SIZE = 256
MASK = np.ones((SIZE, SIZE), bool)
BAND = np.s_[127:130, 100:157]
"""Along the stroke, within the distance where normals lean most."""


def flat() -> NDArray[np.float32]:
    return np.tile(np.float32([0, 0, 1]), (SIZE, SIZE, 1))


def cylinder(bend: int) -> NDArray[np.float32]:
    """Round or hollow about the row of the stroke."""
    up = bend * (128.5 - (np.arange(SIZE, dtype=np.float32) + 0.5)) / SIZE
    normals = np.stack([np.zeros_like(up), up, np.sqrt(1 - up**2)], axis=1)
    return np.tile(normals[:, None], (1, SIZE, 1))


def stroke(bend: int) -> BendStroke:
    return BendStroke(np.float32([[90, 128.5], [166, 128.5]]), bend)


@pytest.mark.parametrize("bend", [ROUND, HOLLOW])
@pytest.mark.parametrize("before", [ROUND, 0, HOLLOW])
def test_the_surface_bends_as_the_stroke_says(bend: int, before: int) -> None:
    normals = cylinder(before)
    if before:
        assert (np.sign(divergence(normals, MASK, 2)[BAND]) == before).all()
    follow_strokes(normals, MASK, [stroke(bend)])
    assert (np.sign(divergence(normals, MASK, 2)[BAND]) == bend).all()
    assert np.linalg.norm(normals, axis=2) == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("bend", [ROUND, HOLLOW])
def test_a_surface_that_bends_so_already_stays(bend: int) -> None:
    normals = cylinder(bend)
    follow_strokes(normals, MASK, [stroke(bend)])
    assert normals == pytest.approx(cylinder(bend), abs=1e-6)


def test_it_leans_to_a_hollow_by_a_known_amount_and_only_near() -> None:
    normals = flat()
    follow_strokes(normals, MASK, [stroke(HOLLOW)])
    above, below = normals[124, 128], normals[132, 128]  # SIZE / 64 pixels away
    lean = TILT / np.hypot(1, TILT)
    assert above == pytest.approx([0, -lean, lean / TILT], abs=1e-6)
    assert below == pytest.approx([0, lean, lean / TILT], abs=1e-6)
    far = np.ones((SIZE, SIZE), bool)
    far[110:148, 72:185] = False
    np.testing.assert_array_equal(normals[far], flat()[far])


@pytest.mark.parametrize("points", [[[-900, -900], [-800, -900]], [[3, 3]], [[-5, 1], [300, 300]]])
def test_a_stroke_may_lie_anywhere(points: list[list[float]]) -> None:
    for shape in ((256, 256), (1, 40), (5, 3)):
        normals = np.tile(np.float32([0, 0, 1]), (*shape, 1))
        follow_strokes(normals, np.ones(shape, bool), [BendStroke(np.float32(points), HOLLOW)])
        assert np.linalg.norm(normals, axis=2) == pytest.approx(1, abs=1e-6)
