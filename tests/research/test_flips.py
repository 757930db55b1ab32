"""Cuts that are kept, swap sides, vanish and appear."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lampblack_research.evaluation.flips import Carry, Cuts, FlipMeter, Flips

SIZE = 200

Image = NDArray[np.float32]


def disk(jump: float, right: int = 0, also: float = 0) -> Image:
    """A plate with a disk ``jump`` in front of it, moved to the right; and another one."""
    rows, columns = np.indices((SIZE, SIZE)) - SIZE / 2
    height = np.zeros((SIZE, SIZE), np.float32)
    height[np.hypot(rows, columns - right) < 40] = jump
    height[np.hypot(rows - 60, columns + 60) < 15] = also
    height[np.maximum(abs(rows), abs(columns)) > 90] = np.nan
    return height


def moved(right: float) -> Carry:
    return lambda points: points + np.array([right, 0], np.float32)


def flips(*heights: Image, right: float = 0) -> Flips:
    meter = FlipMeter()
    for index, height in enumerate(heights):
        carries = (moved(right), moved(-right)) if index else (None, None)
        meter.add(height, *carries)
    return meter.flips


def test_a_cut_that_stays_or_moves_along_does_not_flip() -> None:
    assert flips(disk(20), disk(20), disk(20)) == Flips(1, 0, 0)
    assert flips(disk(20), disk(12)) == Flips(1, 0, 0)
    assert flips(disk(20), disk(20, right=15), right=15) == Flips(1, 0, 0)
    assert flips(disk(20, also=9), disk(20, also=9)).cuts == 2


def test_a_cut_that_swaps_its_sides_flips_once() -> None:
    assert flips(disk(20), disk(-20)) == Flips(1, 100, 100)
    assert flips(disk(20, also=20), disk(20, also=-20)) == Flips(2, 50, 50)
    assert flips(disk(20), disk(20), disk(-20)) == Flips(1, 50, 50)


def test_cuts_that_vanish_or_appear_flip() -> None:
    gone, come = flips(disk(20), disk(0)), flips(disk(0), disk(20))
    assert gone == come == Flips(1, 0, 100)
    assert flips(disk(20, also=20), disk(20)) == Flips(2, 0, 50)


def test_a_jump_at_the_threshold_does_not_flip() -> None:
    above, below = 0.021 * 180, 0.019 * 180
    assert flips(disk(above), disk(below), disk(above)).flips == 0


def test_what_cannot_be_followed_does_not_count() -> None:
    meter = FlipMeter()
    meter.add(disk(20), None, None)
    meter.add(disk(-20), lambda points: None, lambda points: np.full_like(points, np.nan))
    assert meter.flips.cuts == 0
    assert np.isnan(meter.flips.flips)
    assert np.isnan(FlipMeter().flips.cuts)


def test_short_cuts_are_not_followed() -> None:
    height = disk(0)
    height[100:102, 100:102] = 20
    assert Cuts(height).strokes == []
    assert len(Cuts(disk(20)).strokes) == 1
