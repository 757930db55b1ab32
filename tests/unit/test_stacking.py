"""Stacking: a body rests on what is below it, nothing is pierced, and order is as painted."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.surface import (
    Base,
    Relief,
    build_relief,
    check_relief,
    joined_reliefs,
    visible_faces,
)
from lampblack.surface.relief import BACK_DEPTH, THICKNESS
from lampblack.surface.stacking import FLAT, GAP, Sheet, stack

Heights = NDArray[np.float32]
SIZE = 200


def grid(height: int = SIZE, width: int = SIZE) -> tuple[Heights, Heights]:
    rows, columns = np.indices((height, width), np.float32) + np.float32(0.5)
    return columns, rows


def sheet(
    height: Heights,
    mask: NDArray[np.bool_],
    width: float,
    *,
    at: tuple[float, float] = (0, 0),
    scale: float = 1.0,
    joint: Heights | None = None,
) -> Sheet:
    none = np.zeros(mask.shape, np.float32)
    own = np.where(mask, height, 0).astype(np.float32)
    return Sheet(own, mask, none if joint is None else joint, at[0], at[1], scale, width)


def plate(level: float = 10) -> Sheet:
    mask = np.ones((SIZE, SIZE), bool)
    return sheet(np.full(mask.shape, level, np.float32), mask, SIZE)


def sphere(radius: float, x: float = 100, y: float = 100) -> Sheet:
    columns, rows = grid()
    square = radius**2 - (columns - x) ** 2 - (rows - y) ** 2
    return sheet(np.sqrt(np.maximum(square, 0)), square > 0, 2 * radius)


def capsule(y: float, left: float, right: float, radius: float) -> Sheet:
    columns, rows = grid()
    beside = columns - np.clip(columns, left, right)
    square = radius**2 - beside**2 - (rows - y) ** 2
    return sheet(np.sqrt(np.maximum(square, 0)), square > 0, 2 * radius)


def under(base: Base, own: Sheet) -> Heights:
    """The base at each element of a sheet."""
    columns, rows = grid(*own.mask.shape)
    return base.at(columns * own.scale + own.left, rows * own.scale + own.top)


def test_a_disk_rests_on_a_plate() -> None:
    disk = sphere(20)
    low, base = stack([plate(10), disk])
    assert low is FLAT
    gap = GAP * disk.width + THICKNESS
    back = under(base, disk) - BACK_DEPTH * disk.height
    # At its thickest it lies on the plate; the base is level.
    assert back[disk.mask].min() == pytest.approx(10 + gap, abs=0.6)
    assert np.ptp(under(base, disk)[disk.mask]) < 1


def test_an_arm_rests_on_a_ball_and_does_not_pierce_it() -> None:
    ball, arm = sphere(80), capsule(90, 40, 180, 15)
    _, base = stack([ball, arm])
    over = ball.mask & arm.mask
    level = under(base, arm)
    space = (level - BACK_DEPTH * arm.height - THICKNESS - ball.height)[over]
    assert space.min() > 0
    assert space.min() < GAP * arm.width + 4  # it rests, and does not hover
    # It is straight: it bends much less than the ball under it.
    assert np.ptp(level[over]) < 0.2 * np.ptp(ball.height[over])


def test_beyond_what_it_lies_on_a_body_falls_back_to_the_paper() -> None:
    ball, arm = sphere(45, 50, 100), capsule(95, 40, 185, 12)
    _, base = stack([ball, arm])
    along = under(base, arm)[95, 95:197]
    assert along[-1] < 0.6 * along[0]
    assert (np.diff(along) <= 1e-3).all()
    assert np.abs(np.diff(along)).max() < 1.2


def test_larger_bodies_keep_a_larger_gap() -> None:
    gaps = []
    for radius in (6, 22):
        disk = sphere(radius)
        _, base = stack([plate(10), disk])
        back = under(base, disk) - BACK_DEPTH * disk.height
        gaps.append(back[disk.mask].min() - 10 - THICKNESS)
    assert gaps[1] > gaps[0] > 0
    assert gaps[1] == pytest.approx(GAP * 44, abs=0.6)


def test_bodies_that_do_not_meet_stay_on_the_paper() -> None:
    bases = stack([sphere(30, 50, 50), sphere(30, 150, 150), sphere(20, 150, 40)])
    assert all(not base.nodes.any() for base in bases)


def test_parts_that_touch_nothing_stay_on_the_paper() -> None:
    one, other = sphere(20, 100, 100), sphere(20, 170, 30)
    both = sheet(one.height + other.height, one.mask | other.mask, 40)
    _, base = stack([sphere(60, 90, 110), both])
    level = under(base, both)
    assert level[one.mask].min() > 50
    assert np.abs(level[other.mask]).max() < 0.5


def test_a_joint_starts_at_the_surface_below() -> None:
    ball, arm = sphere(80, 80, 100), capsule(100, 90, 185, 15)
    columns, _ = grid()
    end = np.clip(1 - (columns - 75) / 30, 0, 1).astype(np.float32)
    free = stack([ball, arm])[1]
    held = stack([ball, sheet(arm.height, arm.mask, arm.width, joint=end)])[1]
    rows = slice(99, 101), slice(77, 80)  # the end of the arm
    step = [float((under(b, arm) + arm.height - ball.height)[rows].mean()) for b in (free, held)]
    assert 0 < step[1] < 0.7 * step[0]
    front = under(held, arm) + arm.height
    assert (front > ball.height)[ball.mask & arm.mask].all()


def test_resolution_and_place_change_little() -> None:
    def base_of(scale: int, shift: float) -> Heights:
        near = [plate_of(s, scale, shift) for s in (sphere(80), capsule(90, 40, 180, 15))]
        base = stack(near)[1]
        return base.at(np.array([60, 110, 160.0]) + shift, np.array([90, 90, 90.0]) + shift)

    def plate_of(own: Sheet, scale: int, shift: float) -> Sheet:
        part = slice(scale // 2, None, scale)
        return sheet(
            own.height[part, part], own.mask[part, part], own.width, at=(shift, shift), scale=scale
        )

    fine = base_of(1, 0)
    assert np.abs(base_of(2, 0) - fine).max() < 4
    assert np.abs(base_of(1, -31) - fine).max() < 4


def mesh_of(sheets: list[Sheet], stride: int = 1) -> Relief:
    reliefs = []
    for own, base in zip(sheets, stack(sheets), strict=True):
        relief = build_relief(own.height, own.mask, stride=stride)
        x, y, _ = relief.vertices.T
        relief.vertices[:, 2] += base.at(x, y)
        reliefs.append(relief)
    return joined_reliefs(reliefs)


def test_the_order_of_the_mesh_is_that_of_the_painting() -> None:
    random = np.random.default_rng(5)
    for _ in range(4):
        sheets = [sphere(70)]
        for _ in range(4):
            x, y, length = random.uniform(30, 170), random.uniform(30, 170), random.uniform(0, 120)
            radius = random.uniform(5, 25)
            sheets.append(capsule(y, x - length / 2, x + length / 2, radius))
        relief = mesh_of(sheets)
        assert check_relief(relief) == []
        assert relief.bodies is not None
        hit = visible_faces(relief.vertices, relief.faces, (SIZE, SIZE))
        top = np.full((SIZE, SIZE), -1)
        for index, own in enumerate(sheets):
            top[own.mask] = index
        seen = np.where(hit.face >= 0, relief.bodies[relief.faces[hit.face, 0]], -1)
        assert np.array_equal(seen[top >= 0], top[top >= 0])


def test_joined_reliefs_keep_front_and_back_apart() -> None:
    relief = mesh_of([sphere(40), sphere(20, 110, 90)], stride=3)
    half = len(relief.vertices) // 2
    assert relief.bodies is not None
    assert np.array_equal(relief.vertices[:half, :2], relief.vertices[half:, :2])
    assert (relief.vertices[:half, 2] > relief.vertices[half:, 2]).all()
    assert np.array_equal(relief.bodies[:half], relief.bodies[half:])
    assert (relief.bodies[relief.faces] == relief.bodies[relief.faces[:, :1]]).all()
