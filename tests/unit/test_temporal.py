"""Steady normals: registration against known motion, and what averaging may and may not do."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy import ndimage

from lampblack.normals.prediction import Prediction
from lampblack.normals.temporal.flow import dense_flow
from lampblack.normals.temporal.neighbours import neighbour_keys
from lampblack.normals.temporal.registration import places_in, rigid_registration
from lampblack.normals.temporal.rigid import Motion, rigid_motion
from lampblack.normals.temporal.temporal_filter import NO_NEIGHBOURS, Neighbours, TemporalFilter
from lampblack.normals.temporal.thumbnail import RegistrationThumbnail, make_thumbnail
from lampblack_research.evaluation.flicker import FlickerMeter

Image = NDArray[np.float32]
SIZE = 200


def character(angle: float = 0.0, shift: tuple[float, float] = (0.0, 0.0)) -> tuple[Image, Image]:
    """Lines and mask of an inked egg with two marks, turned (degrees, anticlockwise) about the
    middle of the picture and then shifted (down, right)."""
    rows, columns = np.mgrid[0:SIZE, 0:SIZE] + 0.5 - SIZE / 2
    rows, columns = rows - shift[0], columns - shift[1]
    cos, sin = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    y, x = cos * rows + sin * columns, cos * columns - sin * rows
    inside = 60 - np.hypot(x * 1.5, y)
    marks = [3 - np.hypot(x - 10, y + 25), 2 - np.abs(y - 15) - 0.1 * np.abs(x)]
    ink = np.clip(np.maximum.reduce([3 - np.abs(inside - 3), *marks]) / 2, 0, 1)
    mask = inside > 0
    return (ink * mask).astype(np.float32), mask.astype(np.float32)


def bowl(mask: Image, tilt: tuple[float, float] = (0.0, 0.0)) -> Image:
    """Unit normals that lean away from the centroid, and by ``tilt`` (x, y) besides."""
    row, column = ndimage.center_of_mass(mask)
    rows, columns = np.indices(mask.shape)
    x, y = (columns - column) / 80 + tilt[0], (row - rows) / 80 + tilt[1]
    normals = np.stack([x, y, np.ones_like(x)], axis=2)
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    return (normals * mask[..., None]).astype(np.float32)


def small(name: str, lines: Image, mask: Image, normals: Image) -> RegistrationThumbnail:
    return make_thumbnail(name, lines, mask > 0, np.ones((*mask.shape, 3), np.float32), normals)


def angles(a: Image, b: Image) -> Image:
    return np.degrees(np.arccos(np.clip(np.einsum("...c,...c->...", a, b), -1, 1)))


def shot(
    noise: float, count: int = 7, step: tuple[float, float] = (0.0, 4.0)
) -> list[tuple[Image, NDArray[np.bool_], RegistrationThumbnail]]:
    """A character that moves by ``step`` a drawing, each with another smooth error of normals."""
    drawings = []
    for index in range(count):
        rng = np.random.default_rng(index)
        lines, mask = character(2.0 * index, (step[0] * index, step[1] * index))
        normals = bowl(mask, tuple(noise * rng.standard_normal(2)))
        drawings.append((normals, mask > 0, small(str(index), lines, mask, normals)))
    return drawings


def neighbours_of(shown: list[RegistrationThumbnail], index: int) -> Neighbours:
    return Neighbours(tuple(shown[max(0, index - 2) : index][::-1]), tuple(shown[index + 1 :][:2]))


def test_rigid_motion_is_found_to_a_tenth_of_a_cell() -> None:
    turn, shift = 12.0, (9.0, -14.0)
    here, other = (
        small("a", *character(), bowl(character()[1])),
        small("b", *character(turn, shift), bowl(character(turn, shift)[1])),
    )
    motion = rigid_motion(here.features, other.features, Motion(here.centre, other.centre), 0)
    assert np.degrees(motion.angle) == pytest.approx(turn, abs=0.2)
    middle = motion(np.array([[[here.centre[0]]], [[here.centre[1]]]], np.float32))[:, 0, 0]
    assert middle == pytest.approx(other.centre, abs=0.1)


def test_flow_finds_a_smooth_bend() -> None:
    lines, mask = character()
    here = small("a", lines, mask, bowl(mask)).features
    rows, columns = np.indices(here.shape[1:], np.float32)
    bend = 2.5 * np.sin(rows / 20)
    bent = np.stack(
        [ndimage.map_coordinates(plane, [rows, columns - bend], order=1) for plane in here]
    )
    flow = dense_flow(here, bent.astype(np.float32))
    ink = here[1] > 0.3
    assert np.abs(flow[1] - bend)[ink].mean() < 0.35
    assert np.abs(flow[0])[ink].mean() < 0.35


def test_canvases_of_other_sizes_are_laid_over_each_other() -> None:
    lines, mask = character()
    normals = bowl(mask)
    here = small("a", lines, mask, normals)
    margin = ((30, 70), (90, 10))
    wide = small(
        "b", *(np.pad(n, margin) for n in (lines, mask)), np.pad(normals, (*margin, (0, 0)))
    )
    places = places_in(here, wide)
    assert np.abs(places - np.indices(places.shape[1:])).max() < 0.05
    assert np.abs(TemporalFilter().change(here, Neighbours((wide,)))).max() < 0.01
    speck = small(
        "c", lines[95:105, 95:105], np.ones((10, 10), np.float32), normals[95:105, 95:105]
    )
    assert np.abs(TemporalFilter().change(here, Neighbours((speck,), (speck,)))).mean() < 0.05


def test_normals_turn_with_the_drawing() -> None:
    lines, mask = character()
    sideways = np.zeros((*mask.shape, 3), np.float32)
    sideways[mask > 0] = [0.6, 0.0, 0.8]
    turned_lines, turned_mask = character(30.0)
    cos, sin = np.cos(np.radians(30)), np.sin(np.radians(30))
    turned = np.zeros_like(sideways)
    turned[turned_mask > 0] = [0.6 * cos, 0.6 * sin, 0.8]
    here = small("a", lines, mask, sideways)
    other = small("b", turned_lines, turned_mask, turned)
    inside = here.inside > 0.99
    assert np.abs(TemporalFilter().change(here, Neighbours((other,))))[:, inside].mean() < 0.01
    assert np.degrees(rigid_registration(here, other).turn()).mean() == pytest.approx(30, abs=0.5)


def test_the_same_drawing_is_left_as_it_is() -> None:
    normals, mask, here = shot(0.1)[3]
    smoothed = TemporalFilter().smooth(normals, mask, here, Neighbours((here, here), (here,)))
    assert angles(smoothed, normals)[mask].max() < 0.2


def test_alone_nothing_changes() -> None:
    normals, mask, here = shot(0.1)[3]
    smoothed = TemporalFilter().smooth(normals, mask, here, NO_NEIGHBOURS)
    assert angles(smoothed, normals)[mask].max() < 0.1
    assert not smoothed[~mask].any()


def test_flicker_falls_below_half_and_true_normals_are_kept() -> None:
    drawings = shot(0.08)
    temporal_filter, found = TemporalFilter(), []
    before, after = FlickerMeter(temporal_filter), FlickerMeter(temporal_filter)
    minis = [mini for _, _, mini in drawings]
    for i, (normals, mask, here) in enumerate(drawings):
        neighbours = neighbours_of(minis, i)
        smoothed = temporal_filter.smooth(normals, mask, here, neighbours)
        assert np.linalg.norm(smoothed[mask], axis=1) == pytest.approx(1, abs=1e-5)
        assert not smoothed[~mask].any()
        found.append(angles(smoothed, bowl(mask.astype(np.float32)))[mask].mean())
        before.add(here)
        after.add(temporal_filter.smoothed(here, neighbours))
    raw = [angles(n, bowl(mask.astype(np.float32)))[mask].mean() for n, mask, _ in drawings]
    assert np.mean(found) < 0.75 * np.mean(raw)
    assert before.flicker.motion < 0.6
    for kind in ("rigid", "local", "jitter"):
        assert getattr(after.flicker, kind) < 0.5 * getattr(before.flicker, kind)


def test_even_change_does_not_lag() -> None:
    """Normals that lean over steadily are where they should be, in the middle of the shot."""
    drawings = []
    for index in range(5):
        lines, mask = character(0, (0, 3.0 * index))
        normals = bowl(mask, (0.08 * (index - 2), 0))
        drawings.append((normals, mask > 0, small(str(index), lines, mask, normals)))
    normals, mask, here = drawings[2]
    minis = [mini for _, _, mini in drawings]
    smoothed = TemporalFilter().smooth(normals, mask, here, neighbours_of(minis, 2))
    assert angles(smoothed, normals)[mask].mean() < 0.5


def test_a_cut_takes_nothing_over() -> None:
    normals, mask, here = shot(0.0)[0]
    rows, columns = np.mgrid[0:SIZE, 0:SIZE]
    other_mask = ((rows // 20 + columns // 30) % 2 == 0) & (columns > 20) & (rows > 60)
    edges = other_mask & ~ndimage.binary_erosion(other_mask)
    elsewhere = np.zeros_like(normals)
    elsewhere[other_mask] = [0.8, 0, 0.6]
    other = small("cut", edges.astype(np.float32), other_mask.astype(np.float32), elsewhere)
    smoothed = TemporalFilter().smooth(normals, mask, here, Neighbours((other,), (other,)))
    assert angles(smoothed, normals)[mask].mean() < 1.5


def test_what_enters_disturbs_nothing_else() -> None:
    """A second character comes in: it and the first keep their normals."""
    lines, mask = character(0, (0, -40))
    normals = bowl(mask)
    here = small("one", lines, mask, normals)
    ball = np.hypot(*(np.mgrid[0:SIZE, 0:SIZE] - np.array([100, 170])[:, None, None])) < 18
    both_mask = np.maximum(mask, ball)
    both_lines = np.maximum(lines, ball & ~ndimage.binary_erosion(ball, iterations=2))
    both_normals = normals.copy()
    both_normals[ball] = [-0.6, 0, 0.8]
    both = small("two", both_lines.astype(np.float32), both_mask, both_normals)
    smoothed = TemporalFilter().smooth(
        both_normals, both_mask > 0, both, Neighbours((here,), (here,))
    )
    assert angles(smoothed, both_normals)[ball].mean() < 1
    assert angles(smoothed, both_normals)[mask > 0].mean() < 1


def test_the_order_of_asking_changes_nothing() -> None:
    drawings = shot(0.08)
    minis = [mini for _, _, mini in drawings]

    def all_of(order: list[int]) -> dict[int, Image]:
        temporal_filter = TemporalFilter()
        return {i: temporal_filter.change(minis[i], neighbours_of(minis, i)) for i in order}

    forwards, backwards = all_of([0, 1, 2, 3, 4]), all_of([4, 0, 3, 1, 2])
    for i, change in forwards.items():
        assert np.array_equal(change, backwards[i])


def test_neighbours_skip_holds_and_close_cycles() -> None:
    assert neighbour_keys(["a"], 2) == {"a": ((), ())}
    assert neighbour_keys(list("aabbbc"), 2) == {
        "a": ((), ("b", "c")),
        "b": (("a",), ("c",)),
        "c": (("b", "a"), ()),
    }
    cycle = neighbour_keys(list("abcdabcd"), 2)
    assert cycle["a"] == (("d", "c"), ("b", "c"))
    assert cycle["d"] == (("c", "b"), ("a", "b"))
    assert neighbour_keys([], 2) == {}


def test_flicker_of_fewer_than_two_drawings_is_unknown() -> None:
    meter = FlickerMeter(TemporalFilter())
    meter.add(shot(0.0, 1)[0][2])
    assert np.isnan([meter.flicker.rigid, meter.flicker.local, meter.flicker.jitter]).all()


def test_depth_and_edges_are_averaged_and_constants_of_depth_are_not() -> None:
    """They move with the character. Each drawing's depth has an error of its own besides."""
    truth, drawings = [], []
    for index in range(5):
        lines, mask = character(0, (0.0, 4.0 * index))
        rows, columns = np.indices(mask.shape)
        depth = np.where(rows > 100 + 0 * columns, 20.0, 0.0) * mask
        error = 6.0 if index % 2 else -4.0  # on the upper half alone, of mean 0
        noisy = (depth + np.where(rows < 80, error, 0) + 30 * (index - 2)) * mask
        edge = np.where(index == 2, 0.2, 0.7) * mask
        normals = bowl(mask)
        votes = np.dstack([0 * mask, mask if index != 2 else 0 * mask])  # the side above
        order = np.dstack([votes, noisy, edge]).astype(np.float32)
        colour = np.ones((*mask.shape, 3), np.float32)
        mini = make_thumbnail(str(index), lines, mask > 0, colour, normals, order)
        seen = Prediction(normals, noisy.astype(np.float32), edge.astype(np.float32))
        truth.append(depth)
        drawings.append((seen, mask > 0, mini))
    seen, mask, here = drawings[2]
    around = neighbours_of([mini for _, _, mini in drawings], 2)
    found = TemporalFilter().smooth_prediction(seen, mask, here, around)
    assert found.depth is not None
    assert found.edge is not None
    rows, inner = np.indices(mask.shape)[0], ndimage.binary_erosion(mask, iterations=6)
    upper, lower = inner & (rows < 72), inner & (rows > 110)
    raw = seen.depth[upper].mean() - seen.depth[lower].mean()  # type: ignore[index]
    step = found.depth[upper].mean() - found.depth[lower].mean()
    assert abs(step + 20) < 0.5 * abs(raw + 20)
    assert 0.4 < found.edge[inner].mean() < 0.65
    assert not found.depth[~mask].any()
    assert found.votes is not None
    assert found.votes[inner].mean(axis=0) == pytest.approx([0, 0.8], abs=0.1)
    assert np.array_equal(found.normals, TemporalFilter().smooth(seen.normals, mask, here, around))
