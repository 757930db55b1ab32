"""Figures of depth, against closed forms and their definitions."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from shapes import ball

from lampblack_research.evaluation.depth_figures import DepthFigures, DepthTruth
from lampblack_research.evaluation.jumps import jump_links, jump_pairs, smooth_pairs

SIZE = 240
JUMP = 20.0

Image = NDArray[np.float32]


def plates() -> tuple[Image, Image]:
    """Depth and normals of a square plate, 200 pixels long, with a disk in front of it."""
    rows, columns = np.mgrid[0:SIZE, 0:SIZE] - SIZE / 2 + 0.5
    depth = np.where(np.hypot(rows, columns) < 50, JUMP, 0).astype(np.float32)
    depth[np.maximum(abs(rows), abs(columns)) > 100] = np.nan
    normals = np.zeros((SIZE, SIZE, 3), np.float32)
    normals[..., 2] = np.isfinite(depth)
    return depth, normals


def balls() -> tuple[Image, Image]:
    """Depth and normals of a ball that overlaps a larger one."""
    depth, normals = np.full((SIZE, SIZE), -np.inf), np.zeros((SIZE, SIZE, 3), np.float32)
    rows, columns = np.mgrid[0:SIZE, 0:SIZE] + 0.5
    for x, y, z, radius in ((110, 120, 0, 90), (170, 120, 60, 50)):
        right, up = (columns - x) / radius, (y - rows) / radius
        towards = np.sqrt(np.maximum(1 - right**2 - up**2, 0))
        here = (np.hypot(right, up) < 1) & (z + radius * towards > depth)
        depth[here] = (z + radius * towards)[here]
        normals[here] = np.stack([right, up, towards], axis=2)[here]
    return np.where(np.isinf(depth), np.nan, depth).astype(np.float32), normals


@pytest.mark.parametrize("scene", [plates, balls])
def test_true_depth_is_recovered_and_flat_and_flipped_are_not(scene: object) -> None:
    assert callable(scene)
    depth, normals = scene()
    truth = DepthTruth(depth, normals)
    perfect = truth.measure(depth + 7)  # heights are known up to a shift
    assert perfect.recovered == perfect.recovered_median == 1
    assert perfect.quarter == perfect.sign == 1
    assert perfect.over == perfect.false == perfect.cut == 0
    assert perfect.height_angle < 1
    assert perfect.rmse < 1e-4
    flat = truth.measure(np.zeros_like(depth))
    assert flat.recovered == flat.quarter == flat.sign == flat.over == flat.cut == 0
    assert flat.rmse == pytest.approx(100 * np.nanstd(depth) / truth.length)
    flipped = truth.measure(-depth)
    assert flipped.recovered == -1
    assert flipped.sign == 0
    assert flipped.rmse == pytest.approx(flat.rmse)  # the best scale is not below 0


def test_shares_of_the_jump_are_told_apart() -> None:
    depth, normals = plates()
    truth = DepthTruth(depth, normals)
    low, some, high = (truth.measure(depth * np.float32(share)) for share in (0.2, 0.4, 1.6))
    assert low.recovered == pytest.approx(0.2)
    assert (low.sign, low.quarter, low.over) == (1, 0, 0)
    assert (some.quarter, some.over) == (1, 0)
    assert high.recovered == 1.5
    assert high.over == 1


def test_what_is_invented_on_a_smooth_ball_counts() -> None:
    mask, normals = ball(SIZE, 100.0)
    depth = np.where(mask, 100 * normals[..., 2], np.nan).astype(np.float32)
    truth = DepthTruth(depth, normals)
    right = truth.measure(depth)
    assert right.false == right.cut == 0
    assert right.height_angle < 1
    assert np.isnan(right.recovered)
    cracked = depth.copy()
    cracked[:, SIZE // 2 :] += 10
    wrong = truth.measure(cracked)
    assert 0 < wrong.cut < 0.1
    assert wrong.false == pytest.approx(wrong.cut, abs=0.01)
    assert truth.measure(4 * depth).false > 0.1
    assert truth.measure(np.full_like(depth, np.nan)).false == 1


def test_a_steep_slope_is_no_jump() -> None:
    slope = np.tile(np.arange(40, dtype=np.float32) * 5, (40, 1))
    right, _ = jump_links(slope, 4, 2)
    assert not right.any()
    slope[:, 20:] += 30
    right, down = jump_links(slope, 4, 2)
    assert right.sum() == 40
    assert right[:, 19].all()
    assert not down.any()


def test_figures_are_those_of_the_definitions() -> None:
    """The definitions once more, pair by pair, on a height that is neither right nor wrong."""
    depth, normals = balls()
    truth = DepthTruth(depth, normals)
    rng = np.random.default_rng(3)
    height = (0.5 * depth + np.cumsum(rng.normal(0, 1.5, SIZE))).astype(np.float32)
    length, figures = truth.length, truth.measure(height)
    pairs, jumps = jump_pairs(depth, length)
    assert len(pairs) >= 50
    shares = []
    for row, column, down, right in zip(
        pairs.row, pairs.column, pairs.down, pairs.right, strict=True
    ):
        near, far = (
            (
                round(row + side * 0.0075 * length * down),
                round(column + side * 0.0075 * length * right),
            )
            for side in (1, -1)
        )
        assert depth[near] - depth[far] > 0.02 * length
        shares.append((height[near] - height[far]) / (depth[near] - depth[far]))
    assert np.allclose(jumps > 0, True)
    assert figures.recovered == pytest.approx(np.mean(np.clip(shares, -1, 1.5)), abs=1e-6)
    assert figures.recovered_median == pytest.approx(np.median(shares), abs=1e-6)
    assert figures.quarter == pytest.approx(np.mean(np.array(shares) >= 0.25))
    assert figures.sign == pytest.approx(np.mean(np.array(shares) > 0))
    assert figures.over == pytest.approx(np.mean(np.array(shares) > 1.5))
    wrong = []
    smooth = smooth_pairs(depth, length)
    for row, column, down, right in zip(
        smooth.row, smooth.column, smooth.down, smooth.right, strict=True
    ):
        a, b = (
            (
                round(row + side * 0.0075 * length * down),
                round(column + side * 0.0075 * length * right),
            )
            for side in (1, -1)
        )
        wrong.append(abs((height[a] - height[b]) - (depth[a] - depth[b])) > 0.02 * length)
    assert figures.false == pytest.approx(np.mean(wrong))
    assert isinstance(figures, DepthFigures)
