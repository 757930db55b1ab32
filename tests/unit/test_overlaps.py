"""Steps of the surface where one part overlaps another, against closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from lampblack.choices import FrontSide
from lampblack.normals.prediction import Prediction, pack_order, unpack_order
from lampblack.scene import DepthHint, DepthPoint
from lampblack.surface import (
    build_relief,
    check_relief,
    dividing_lines,
    overlap_votes,
    solve,
    solve_with_overlaps,
)
from lampblack.surface.cuts import Cuts, across
from lampblack.surface.direct import Prior, inflate_direct
from lampblack.surface.overlap import Overlap, pack_overlaps, unpack_overlaps
from lampblack.surface.repeats import Repeats, repeats_among
from lampblack.surface.strokes import Stroke, find_strokes

Image = NDArray[np.float32]
Mask = NDArray[np.bool_]

SIZE = 200
STEP = 24.0
"""How far the small disk of ``two_disks`` lies before the large one."""


def flat_normals(mask: Mask) -> Image:
    return np.dstack([np.zeros((*mask.shape, 2)), mask]).astype(np.float32)


def ring(radius: float, count: int = 400) -> Image:
    turn = np.linspace(0, 2 * np.pi, count)
    return (SIZE / 2 + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)).astype(np.float32)


def disk(row: float, column: float, radius: float) -> Mask:
    rows, columns = np.mgrid[0:SIZE, 0:SIZE] + 0.5
    return np.asarray(np.hypot(rows - row, columns - column) < radius)


def two_disks() -> tuple[Prediction, Mask, Image, Mask]:
    """A flat disk before a larger one, as the network sees them: prediction, mask, lines, and the
    disk in front."""
    back, front = disk(100, 100, 95), disk(120, 100, 45)
    rim = front & ~ndimage.binary_erosion(front, iterations=2)
    lines = rim | (back & ~ndimage.binary_erosion(back, iterations=2))
    depth = ndimage.gaussian_filter(np.where(front, STEP, 0.0), 4) * back
    edge = np.clip(4 * ndimage.gaussian_filter(rim.astype(np.float64), 3), 0, 1) * back
    seen = Prediction(flat_normals(back), depth.astype(np.float32), edge.astype(np.float32))
    return seen, back, lines.astype(np.float32), front


def test_a_stroke_passes_through_a_junction_and_another_ends_there() -> None:
    ink = np.zeros((100, 120), bool)
    ink[50:53, 10:110] = True
    ink[52:90, 60:63] = True
    bar, stem = sorted(find_strokes(ink, 100.0), key=lambda stroke: -len(stroke.points))
    assert (bar.meets, stem.meets.count(True)) == ((False, False), 1)
    assert np.ptp(bar.points[:, 0]) > 90
    assert np.abs(bar.points[:, 1] - 51.5).max() < 1.5
    assert np.abs(stem.points[:, 0] - 61.5).max() < 1.5


def test_a_ring_of_ink_is_one_closed_stroke() -> None:
    (stroke,) = find_strokes(disk(100, 100, 60) & ~disk(100, 100, 56), 200.0)
    assert stroke.closed
    assert np.abs(np.hypot(*(stroke.points - 100).T) - 58).max() < 1.5


def test_a_stroke_bridges_a_small_gap_and_reaches_the_ink_it_points_at() -> None:
    ink = np.zeros((100, 200), bool)
    ink[50:53, 10:80] = ink[50:53, 83:170] = True
    ink[20:90, 173:176] = True
    bar, post = find_strokes(ink, 400.0)
    if np.ptp(bar.points[:, 0]) < np.ptp(post.points[:, 0]):
        bar, post = post, bar
    assert np.ptp(bar.points[:, 0]) > 155
    assert np.hypot(*np.diff(bar.points, axis=0).T).max() < 2.5
    assert (bar.meets.count(True), post.meets) == (1, (False, False))


@pytest.mark.parametrize("radius", [8.3, 40.0, 71.7])
@pytest.mark.parametrize("side", ["left", "right"])
def test_a_closed_cut_has_no_leak_and_lifts_what_it_encloses(radius: float, side: str) -> None:
    """Flat normals: inside the cut the height is that of outside plus the step, exactly."""
    mask = np.ones((SIZE, SIZE), bool)
    points = ring(radius)
    cuts = Cuts.none(mask.shape)
    towards = across(points, "left" if side == "left" else "right")
    cuts.add(points, towards, np.full(len(points), 7, np.float32), mask)
    height = inflate_direct(flat_normals(mask), mask, cuts, tolerance=1e-6)
    inside, outside = disk(100, 100, radius - 2), ~disk(100, 100, radius + 2)
    # x right and y down: the ring runs clockwise as seen, so its inside is on the right.
    expected = 7 if side == "right" else -7
    assert height[inside].mean() - height[outside].mean() == pytest.approx(expected, abs=1e-3)
    assert np.ptp(height[inside]) < 1e-2
    assert np.ptp(height[outside]) < 1e-2


def test_a_prior_passes_what_is_longer_than_its_reach() -> None:
    """Of a wave of flat normals, lambda / (lambda + k^2) remains."""
    mask = np.ones((60, 240), bool)
    wave = 2 * np.pi / 80
    depth = np.broadcast_to(np.cos(wave * (np.arange(240) + 0.5)), mask.shape) * np.float32(10)
    weight = 0.004
    height = inflate_direct(
        flat_normals(mask), mask, prior=Prior(depth.astype(np.float32), weight), tolerance=1e-6
    )
    expected = depth * weight / (weight + 2 - 2 * np.cos(wave))
    assert np.abs(height - height.mean() - expected).max() < 0.01


def test_a_part_in_front_stands_before_what_it_covers() -> None:
    seen, mask, lines, front = two_disks()
    height, (overlap,) = solve_with_overlaps(seen, mask, lines)
    inner, outer = disk(120, 100, 38), mask & ~disk(120, 100, 52)
    step = height[inner].mean() - height[outer].mean()
    assert 0.5 * STEP < step < 1.5 * STEP
    assert step == pytest.approx(overlap.amount, rel=0.1)
    assert np.ptp(height[inner]) < 1
    assert np.abs(np.hypot(overlap.points[:, 0] - 100, overlap.points[:, 1] - 120) - 44).max() < 2
    beside = overlap.points + 6 * across(overlap.points, "left")
    on_left = front[beside[:, 1].astype(int), beside[:, 0].astype(int)]
    assert on_left.all() == (overlap.front == "left")
    assert on_left.all() == on_left.any()


@pytest.mark.parametrize("fault", ["flat", "no edge", "no depth", "no line"])
def test_where_unsure_the_sides_are_joined(fault: str) -> None:
    seen, mask, lines, _ = two_disks()
    assert seen.depth is not None
    assert seen.edge is not None
    if fault == "flat":
        seen = replace(seen, depth=seen.depth * np.float32(0.05))
    elif fault == "no edge":
        seen = replace(seen, edge=seen.edge * np.float32(0.25))
    elif fault == "no depth":
        seen = replace(seen, depth=None, edge=None)
    else:
        lines = lines * 0
    height, overlaps = solve_with_overlaps(seen, mask, lines)
    assert not overlaps
    assert np.array_equal(height, solve(seen.normals, mask))


def test_hatching_is_not_cut_even_where_the_network_errs() -> None:
    """Short, parallel, free at both ends: its depth and its edges would do for an overlap."""
    seen, mask, lines, _ = two_disks()
    hatched = lines * 0
    for column in range(70, 130, 6):
        hatched[112:128, column : column + 2] = 1
    rows = np.broadcast_to(np.arange(SIZE)[:, None], mask.shape)
    wrong = Prediction(
        seen.normals,
        (np.broadcast_to(np.arange(SIZE) % 12 < 6, mask.shape) * STEP * mask).astype(np.float32),
        (mask & (np.abs(rows - 120) < 12)).astype(np.float32),
    )
    assert not solve_with_overlaps(wrong, mask, hatched)[1]


def test_an_open_end_joins_without_a_step() -> None:
    """Half of the outline is drawn: the step falls to nothing towards its ends."""
    seen, mask, lines, front = two_disks()
    lines[front & (np.arange(SIZE)[:, None] > 125)] = 0
    height, (overlap,) = solve_with_overlaps(seen, mask, lines)
    jump = np.maximum(
        np.abs(np.diff(height, axis=0))[:, :-1] * mask[1:, :-1] * mask[:-1, :-1],
        np.abs(np.diff(height, axis=1))[:-1] * mask[:-1, 1:] * mask[:-1, :-1],
    )
    top, *ends = (
        overlap.points[len(overlap.points) // 2],
        overlap.points[0],
        overlap.points[-1],
    )

    def near(point: Image) -> float:
        x, y = (int(v) for v in point)
        return float(jump[y - 2 : y + 3, x - 2 : x + 3].max())

    assert near(top) > 0.5 * overlap.amount
    assert max(near(end) for end in ends) < 0.2 * near(top)


@pytest.mark.parametrize("stride", [1, 2, 4])
def test_the_relief_of_a_step_is_sound(stride: int) -> None:
    seen, mask, lines, _ = two_disks()
    height, _ = solve_with_overlaps(seen, mask, lines)
    assert check_relief(build_relief(height, mask, stride=stride)) == []


def test_an_inked_drawing_is_divided_by_its_ink_alone() -> None:
    _, mask, lines, front = two_disks()
    ink = np.where(front & ~disk(120, 100, 48), np.float32(0), lines) * ~disk(120, 100, 46)
    assert np.array_equal(dividing_lines(lines, ink.astype(np.float32), mask), ink)
    assert np.array_equal(dividing_lines(lines, ink * 0, mask), lines)


def test_what_is_kept_of_a_prediction_comes_back() -> None:
    seen, mask, _, _ = two_disks()
    back = unpack_order(seen.normals, pack_order(seen, mask), mask)
    assert back.depth is not None
    assert seen.depth is not None
    assert np.abs(back.depth - seen.depth).max() < 0.05 * STEP
    assert unpack_order(seen.normals, pack_order(Prediction(seen.normals), mask), mask).edge is None
    kept = [
        Overlap(np.array([[1, 2], [3, 4.5]], np.float32), "right", 3.5),
        Overlap(np.array([[5, 6]], np.float32), "joined", 0.0, hinted=True),
    ]
    for here, there in zip(kept, unpack_overlaps(pack_overlaps(kept)), strict=True):
        assert np.array_equal(here.points, there.points)
        assert (here.front, here.amount, here.hinted) == (there.front, there.amount, there.hinted)
    assert unpack_overlaps(pack_overlaps([])) == ()


def hint(points: Image, front: FrontSide, amount: float = 0.0) -> DepthHint:
    return DepthHint(1, tuple(DepthPoint(float(x), float(y)) for x, y in points), front, amount)


def lifted(height: Image, mask: Mask) -> float:
    """How far the small disk stands before the large one."""
    inner, outer = disk(120, 100, 38), mask & ~disk(120, 100, 52)
    return float(height[inner].mean() - height[outer].mean())


def rim(radius: float = 44, count: int = 24) -> Image:
    turn = np.linspace(0, 2 * np.pi, count)
    points = [100 + radius * np.cos(turn), 120 + radius * np.sin(turn)]
    return np.stack(points, axis=1).astype(np.float32)


@pytest.mark.parametrize("off", [0, 2])
def test_a_hint_swaps_what_is_in_front(off: int) -> None:
    """The prediction says otherwise, so it brings a step of its own; it need not be drawn well."""
    seen, mask, lines, _ = two_disks()
    _, (found,) = solve_with_overlaps(seen, mask, lines)
    other: FrontSide = "left" if found.front == "right" else "right"
    clicked = found.points[:: len(found.points) // 30] + off
    height, (overlap,) = solve_with_overlaps(seen, mask, lines, [hint(clicked, other)])
    assert overlap.hinted
    assert overlap.amount == pytest.approx(0.05 * 190, rel=0.05)
    assert lifted(height, mask) == pytest.approx(-overlap.amount, rel=0.1)


def test_a_hint_has_its_own_amount_and_a_drawn_one_cuts_where_nothing_was_found() -> None:
    seen, mask, lines, _ = two_disks()
    flat = Prediction(seen.normals)
    assert not solve_with_overlaps(flat, mask, lines)[1]
    for given in (hint(rim(42), "right", 0.1), hint(rim(42)[::-1], "left", 0.1)):
        for drawn in (lines, lines * 0):
            height, (overlap,) = solve_with_overlaps(flat, mask, drawn, [given])
            assert overlap.amount == pytest.approx(0.1 * 190)
            assert lifted(height, mask) == pytest.approx(0.1 * 190, rel=0.1)


def test_a_hint_joins_what_was_cut() -> None:
    seen, mask, lines, _ = two_disks()
    height, (overlap,) = solve_with_overlaps(seen, mask, lines, [hint(rim(), "joined")])
    assert (overlap.front, overlap.amount, overlap.hinted) == ("joined", 0, True)
    assert np.array_equal(height, solve(seen.normals, mask))


def test_a_click_is_about_the_whole_overlap_and_one_far_from_all_about_none() -> None:
    seen, mask, lines, _ = two_disks()
    on, off = np.array([[145, 120]], np.float32), np.array([[100, 120]], np.float32)
    height, _ = solve_with_overlaps(seen, mask, lines, [hint(on, "joined")])
    assert np.array_equal(height, solve(seen.normals, mask))
    untouched, _ = solve_with_overlaps(seen, mask, lines, [hint(off, "joined")])
    assert np.array_equal(untouched, solve_with_overlaps(seen, mask, lines)[0])


def test_a_hint_about_a_part_leaves_the_rest() -> None:
    seen, mask, lines, _ = two_disks()
    _, (found,) = solve_with_overlaps(seen, mask, lines)
    quarter = rim()[2:7]
    _, overlaps = solve_with_overlaps(seen, mask, lines, [hint(quarter, "joined")])
    rest, joined = sorted(overlaps, key=lambda overlap: overlap.hinted)
    assert joined.hinted
    assert rest.front == found.front
    assert 0.6 < len(rest.points) / len(found.points) < 0.9


def test_hints_beyond_the_drawing_do_nothing() -> None:
    seen, mask, lines, _ = two_disks()
    wild = [hint(rim() * 1e30, "left"), hint(rim() * 0, "right"), hint(rim()[:0], "left")]
    height, _ = solve_with_overlaps(seen, mask, lines, wild)
    assert np.array_equal(height, solve_with_overlaps(seen, mask, lines)[0])


def test_the_votes_of_several_drawings_decide() -> None:
    """Each votes for the side that it has in front. What most of them do not show stays joined."""
    seen, mask, lines, _ = two_disks()
    votes = overlap_votes(seen, mask, lines)
    rows, columns = np.nonzero(votes.any(axis=2))
    outward = np.stack([columns - 99.5, 119.5 - rows], axis=1)
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    assert np.einsum("nc,nc->n", outward, votes[rows, columns]).mean() < -0.95
    assert np.abs(np.hypot(rows - 119.5, columns - 99.5) - 44).max() < 6
    assert solve_with_overlaps(replace(seen, votes=0.6 * votes), mask, lines)[1]
    assert not solve_with_overlaps(replace(seen, votes=0.4 * votes), mask, lines)[1]
    assert not solve_with_overlaps(replace(seen, votes=0 * votes), mask, lines)[1]
    swapped, _ = solve_with_overlaps(replace(seen, votes=-votes), mask, lines)
    assert lifted(swapped, mask) < -0.01 * SIZE


def test_stripes_and_spots_are_marks_and_an_outline_is_none() -> None:
    stripes = [
        np.stack([np.full(80, 40.0 + gap), np.arange(60, 140)], axis=1).astype(np.float32)
        for gap in (0, 9, 18, 34, 100)
    ]
    turn = np.linspace(0, 2 * np.pi, 40)
    spot = np.stack([180 + 5 * np.cos(turn), 30 + 5 * np.sin(turn)], axis=1).astype(np.float32)
    strokes = [Stroke(points, (True, True), False) for points in (*stripes, ring(60), spot)]
    found = repeats_among(strokes, (SIZE, SIZE), float(SIZE))
    row, beside, alone = Repeats.REPEATED, Repeats.BESIDE, Repeats.ALONE
    assert found == [row, row, row, beside, alone, alone, row]
