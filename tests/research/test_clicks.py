"""The simulated click corrects the worst overlap, and no other."""

from __future__ import annotations

import numpy as np
import pytest

from lampblack.surface import Overlap
from lampblack_research.evaluation.clicks import (
    best_correction,
    left_above_right,
    worst_missing,
    worst_overlap,
)

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
    hint = worst_overlap([right, shorter, wrong], plates()).hint
    assert hint is not None
    assert hint.front == "left"
    assert (hint.points[0].x, hint.points[0].y) == (100, 100)
    assert worst_overlap([right], plates()).hint is None
    assert worst_overlap([], plates()).hint is None


def test_an_overlap_where_nothing_jumps_is_joined() -> None:
    hint = worst_overlap([Overlap(line(40, 20, 60), "left", 10)], plates()).hint
    assert hint is not None
    assert hint.front == "joined"


@pytest.mark.parametrize("raised", ["right half", "left half"])
def test_a_stroke_is_drawn_along_what_is_missing(raised: str) -> None:
    depth = plates() if raised == "right half" else 20 - plates()
    hint = worst_missing(np.zeros_like(depth), depth).hint
    assert hint is not None
    points = np.array([(p.x, p.y) for p in hint.points])
    assert np.abs(points[:, 0] - SIZE / 2).max() <= 1
    assert np.ptp(points[:, 1]) > 0.9 * SIZE
    assert (np.diff(points[:, 1]) * (points[-1, 1] - points[0, 1]) > 0).all()
    dense = np.linspace(points[0], points[-1], SIZE).astype(np.float32)
    rise = np.nanmedian(left_above_right(dense, depth, 5))
    assert (rise > 0) == (hint.front == "left")
    assert worst_missing(depth, depth).hint is None


def test_of_a_wrong_overlap_and_a_missing_one_the_worse_is_corrected() -> None:
    short = Overlap(line(100, 80, 90), "right", 10)
    drawn = best_correction([short], np.zeros((SIZE, SIZE), np.float32), plates())
    assert drawn is not None
    assert len(drawn.points) > 1
    clicked = best_correction([short], plates(), plates())
    assert clicked is not None
    assert len(clicked.points) == 1
