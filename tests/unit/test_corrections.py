"""Corrections of a surface by hand: closed forms of brushes and volumes, and where they end."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.camera import scene_in_view
from lampblack.hints import HintedDrawing, carry_hints, hint_frames, scaled_hint
from lampblack.normals.prediction import Prediction
from lampblack.normals.temporal.temporal_filter import TemporalFilter
from lampblack.scene import (
    Depth,
    DepthColour,
    DepthPoint,
    DepthStroke,
    decode_scene,
    default_scene,
    encode_scene,
)
from lampblack.surface import (
    Corrections,
    clay_picture,
    depth_picture,
    normals_of,
    solve_with_overlaps,
)
from lampblack.surface.brush import humped, turned
from lampblack.surface.cuts import Cuts
from lampblack.surface.direct import inflate_direct
from lampblack.surface.membrane import membrane
from lampblack.surface.volumes import Volume, with_volumes
from unit.test_hints import character
from unit.test_surface import from_slopes, grid, sphere

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]
SIDE = 120
PLANE = np.zeros((SIDE, SIDE), np.float32)
ALL = np.ones((SIDE, SIDE), bool)
NOWHERE = Cuts.none(ALL.shape)


def stroke(
    *points: tuple[float, float], brush: str = "bump", radius: float = 30.0, amount: float = 0.5
) -> DepthStroke:
    return DepthStroke(1, tuple(DepthPoint(*p) for p in points), brush, radius, amount)  # type: ignore[arg-type]


@pytest.mark.parametrize(("brush", "sign"), [("bump", 1), ("dent", -1)])
def test_a_bump_on_a_plane_is_the_hump_that_is_promised(brush: str, sign: int) -> None:
    found = humped(PLANE, ALL, NOWHERE, [stroke((30, 60), (90, 60), brush=brush)])
    rows, columns = np.indices(ALL.shape) + 0.5
    away = np.hypot(np.maximum(abs(columns - 60) - 30, 0), rows - 60) / 30
    expected = sign * 0.5 * 30 * np.where(away < 1, (1 - away**2) ** 2, 0)
    assert found == pytest.approx(expected, abs=1e-3)
    tilted = PLANE + np.arange(SIDE, dtype=np.float32)
    both = humped(tilted, ALL, NOWHERE, [stroke((30, 60), (90, 60), brush=brush)] * 2)
    assert both - tilted == pytest.approx(2 * expected, abs=1e-3)


def test_a_bump_ends_at_a_cut() -> None:
    cuts = Cuts.none(ALL.shape)
    cuts.right[:, 69] = 5.0
    found = humped(PLANE, ALL, cuts, [stroke((60, 60))])
    whole = humped(PLANE, ALL, NOWHERE, [stroke((60, 60))])
    assert np.array_equal(found[:, :70], whole[:, :70])
    assert not found[:, 70:].any()
    assert whole[:, 70:].any()


def test_strokes_beyond_the_canvas_do_nothing() -> None:
    for points in ([], [(-500.0, 20.0)], [(1e5, 1e5), (-1e5, 1e5)]):
        for brush in ("bump", "turn"):
            given = stroke(*points, brush=brush)
            assert np.array_equal(humped(PLANE, ALL, NOWHERE, [given]), PLANE)
            flat = from_slopes(PLANE, PLANE, ALL)
            assert np.array_equal(turned(flat, ALL, [given]), flat)
    small = stroke((60.5, 60.5), radius=1.0)
    assert humped(PLANE, ALL, NOWHERE, [small]).max() == pytest.approx(0.5)


@pytest.mark.parametrize("angle", [0, 60, 200])
def test_a_turn_gives_the_normal_that_is_wanted(angle: float) -> None:
    way = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    start, end = 60 - 40 * way, 60 + 40 * way
    given = stroke(tuple(start), tuple(end), brush="turn", radius=40, amount=0.5)
    normals = turned(from_slopes(PLANE, PLANE, ALL), ALL, [given])
    unit = normals / np.linalg.norm(normals, axis=2, keepdims=True)
    # Right and up; the canvas counts downwards. Half of a right angle.
    wanted = np.array([way[0], -way[1], 1]) / np.sqrt(2)
    assert unit[60, 60] == pytest.approx(wanted, abs=1e-3)
    assert unit[0, 0] @ [0, 0, 1] == pytest.approx(1)
    # The surface leans that way too, and hardly moves where nothing was said.
    height = inflate_direct(normals, ALL)
    lean = normals_of(height, ALL)[50:70, 50:70].mean(axis=(0, 1))
    assert lean[:2] @ wanted[:2] > 0.7 * wanted[:2] @ wanted[:2]
    assert abs(lean[0] * wanted[1] - lean[1] * wanted[0]) < 0.05


def test_turning_all_of_a_plane_tilts_it() -> None:
    given = stroke((0, 60), (120, 60), brush="turn", radius=1000, amount=0.25)
    height = inflate_direct(turned(from_slopes(PLANE, PLANE, ALL), ALL, [given]), ALL)
    slope = np.diff(height, axis=1)
    assert slope == pytest.approx(np.full_like(slope, -np.tan(np.radians(22.5))), abs=0.02)


def hill(factor: float = 1.0) -> tuple[Floats, Mask]:
    """A slope with a hill of a colour of its own on it, and the colour's region."""
    x, y = grid(SIDE, SIDE)
    away = np.hypot(x, y) / 40
    region = away < 1
    own = np.where(region, 20 * (1 - np.minimum(away, 1) ** 2), 0)
    return (0.3 * x + factor * own).astype(np.float32), region


@pytest.mark.parametrize("factor", [0.0, 0.5, 2.0])
def test_a_factor_multiplies_what_stands_out_of_the_surface_around(factor: float) -> None:
    height, region = hill()
    found = with_volumes(height, ALL, NOWHERE, [Volume(region, factor)], 400)
    inner = np.hypot(*grid(SIDE, SIDE)) < 40 - 0.02 * 400 - 1
    expected, _ = hill(factor)
    assert found[inner] == pytest.approx(expected[inner], abs=0.15)
    assert np.array_equal(found[~region], height[~region])
    # Neither a crack nor a crease: the hill meets the slope at an angle of 45 degrees.
    moved = found - height
    assert abs(np.diff(moved, axis=1)).max() < 1.6
    assert abs(np.diff(moved, n=2, axis=1)).max() < 0.7


def test_a_colour_that_is_all_of_the_character_is_scaled() -> None:
    normals, mask, _ = sphere(160, 70.0)
    height = inflate_direct(normals, mask)
    found = with_volumes(height, mask, Cuts.none(mask.shape), [Volume(mask, 2)], 140)
    assert np.diff(found, axis=1)[80, 30:130] == pytest.approx(
        2 * np.diff(height, axis=1)[80, 30:130], abs=1e-3
    )
    flat = with_volumes(height, mask, Cuts.none(mask.shape), [Volume(mask, 0)], 140)
    assert np.ptp(flat[mask]) < 1e-3


def test_nearer_moves_a_colour_and_keeps_the_surface_whole() -> None:
    height, region = hill()
    for nearer in (12.0, -12.0):
        found = with_volumes(height, ALL, NOWHERE, [Volume(region, 1, nearer)], SIDE)
        moved = found - height
        assert moved[60, 60] == pytest.approx(nearer, abs=1e-3)
        assert not moved[~region].any()
        assert abs(np.diff(moved, axis=0)).max() < 1.1
    # Where it is cut off it moves as a whole.
    cuts = Cuts.none(ALL.shape)
    cuts.right[:, :-1][region[:, :-1] != region[:, 1:]] = 4
    cuts.down[:-1][region[:-1] != region[1:]] = 4
    found = with_volumes(height, ALL, cuts, [Volume(region, 1, 12.0)], SIDE)
    assert (found - height)[region] == pytest.approx(np.full(region.sum(), 12.0))


def test_what_lies_in_a_colour_moves_with_it() -> None:
    height, region = hill()
    eye = np.hypot(*grid(SIDE, SIDE)) < 6
    found = with_volumes(height, ALL, NOWHERE, [Volume(region & ~eye, 0)], SIDE)
    plain = with_volumes(height, ALL, NOWHERE, [Volume(region, 0)], SIDE)
    assert abs(found - plain)[eye].max() < 1.0
    bump = np.where(eye, np.float32(3), np.float32(0))
    with_eye = with_volumes(height + bump, ALL, NOWHERE, [Volume(region & ~eye, 0)], SIDE)
    assert (with_eye - found)[60, 60] == pytest.approx(3, abs=0.5)


def test_a_membrane_is_harmonic_and_meets_what_is_around() -> None:
    x, y = grid(SIDE, SIDE)
    saddle = (x * y / 30 + 0.5 * x).astype(np.float32)
    region = np.hypot(x, y) < 45
    found = membrane(np.where(region, 99, saddle).astype(np.float32), region, ALL, NOWHERE)
    assert found == pytest.approx(saddle, abs=0.05)


def test_corrections_reach_the_surface_of_a_prediction() -> None:
    normals, mask, _ = sphere(160, 70.0)
    seen = Prediction(normals)
    plain, _ = solve_with_overlaps(seen, mask, np.zeros(mask.shape, np.float32))
    given = Corrections((stroke((80, 80)),), (Volume(mask, 0.5),))
    found, _ = solve_with_overlaps(seen, mask, np.zeros(mask.shape, np.float32), (), given)
    expected = humped(0.5 * plain, mask, Cuts.none(mask.shape), given.strokes)
    assert found[mask] == pytest.approx(expected[mask], abs=0.1)


def test_a_clay_picture_shows_small_bumps_on_a_deep_surface() -> None:
    slope = np.repeat(np.linspace(0, 500, SIDE, dtype=np.float32)[:, None], SIDE, 1)
    bumped = humped(slope, ALL, NOWHERE, [stroke((60, 60), radius=10.0)])
    plain, clay = depth_picture(bumped, ALL), clay_picture(bumped, ALL, 1)
    assert (clay[..., :3] <= plain[..., :3]).all()
    row = clay[60, 50:71, 0].astype(int)
    assert row[5] - row[15] > 5  # the light comes from the left
    assert clay[100, 60, 0] > clay[20, 60, 0]  # and near is bright


def test_strokes_move_with_the_character_and_add_up() -> None:
    here, there = character(), character(turned=8.0, shift=(22, -9))
    near, far = (stroke((250.0, 280.0), (310.0, 300.0), brush="turn") for _ in range(2))
    carried = carry_hints(
        [HintedDrawing(here, (near,)), HintedDrawing(here, (far,))], there, TemporalFilter()
    )
    assert len(carried) == 2
    angle = np.radians(8.0)
    for found in carried:
        assert isinstance(found, DepthStroke)
        assert (found.brush, found.radius) == ("turn", 30.0)
        for before, after in zip(near.points, found.points, strict=True):
            x, y = before.x - 280, before.y - 280
            right = 280 + np.cos(angle) * x + np.sin(angle) * y + 22
            down = 280 - np.sin(angle) * x + np.cos(angle) * y - 9
            assert np.hypot(after.x - right, after.y - down) < 3
    depth = Depth(strokes=(replace(near, frame=7),))
    assert hint_frames(depth, 9) == [7]


def test_a_camera_takes_strokes_along() -> None:
    said = Depth(
        strokes=(stroke((10, 20), (30, 20), brush="turn"),), colours=(DepthColour("#102030", 2),)
    )
    scene = replace(default_scene(100, 80), depth=said)
    seen = scene_in_view(scene, (2, 0, 30, 0, 2, -10), (300, 200)).depth
    assert [(p.x, p.y) for p in seen.strokes[0].points] == [(50, 30), (90, 30)]
    assert seen.strokes[0].radius == 60
    assert seen.colours == said.colours
    half = scaled_hint(said.strokes[0], 0.5, left=10, top=20)
    assert [(p.x, p.y) for p in half.points] == [(0, 0), (10, 0)]
    assert half.radius == 15
    assert decode_scene(encode_scene(scene)).depth == said
