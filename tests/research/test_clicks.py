"""The simulated click corrects the worst overlap, and no other."""

from __future__ import annotations

import numpy as np
import pytest

from lampblack.surface import Overlap
from lampblack_research.evaluation.clicks import left_above_right, worst_overlap

SIZE = 200


def plates() -> np.ndarray:
    """A picture whose right half is 20 in front of its left half."""
    depth = np.zeros((SIZE, SIZE), np.float32)
    depth[:, SIZE // 2 :] = 20
    return depth


def line(x: float, top: float, bottom: float) -> np.ndarray:
    """Points down the canvas, or up if ``top`` lies below ``bottom``."""
    y = np.linspace(top, bottom, round(abs(bottom - top)) + 1)
    return np.column_stack([np.full_like(y, x), y]).astype(np.float32)


def test_left_is_left_of_the_walker_as_seen_on_the_canvas() -> None:
    # Walking down the canvas, the right half of the picture is on the left hand.
    assert left_above_right(line(100, 20, 180), plates(), 5) == pytest.approx(20)
    assert left_above_right(line(100, 180, 20), plates(), 5) == pytest.approx(-20)
    assert np.isnan(left_above_right(line(198, 20, 180), plates(), 5)).all()


def test_the_longest_wrong_overlap_is_turned() -> None:
    right = Overlap(line(100, 20, 60), "left", 10)
    wrong = Overlap(line(100, 80, 120), "right", 10)
    shorter = Overlap(line(100, 130, 140), "right", 10)
    hint = worst_overlap([right, shorter, wrong], plates())
    assert hint is not None
    assert hint.front == "left"
    assert (hint.points[0].x, hint.points[0].y) == (100, 100)
    assert worst_overlap([right], plates()) is None
    assert worst_overlap([], plates()) is None


def test_an_overlap_where_nothing_jumps_is_joined() -> None:
    hint = worst_overlap([Overlap(line(40, 20, 60), "left", 10)], plates())
    assert hint is not None
    assert hint.front == "joined"
