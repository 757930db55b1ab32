"""Marks drawn over training pictures: inside the character, and no part of its shape."""

from __future__ import annotations

import numpy as np
import pytest

from lampblack_research.dataset import marks
from lampblack_research.dataset.marks import random_marks
from lampblack_research.dataset.triple import DEPTH_STEPS, Triple
from lampblack_research.training import character_batches
from lampblack_research.training.character_batches import place_on_canvas

ROWS, COLUMNS = np.mgrid[-60:60, -60:60].astype(np.float32)
BALL = np.hypot(ROWS, COLUMNS) < 50
DEPTH = np.sqrt(np.maximum(2500 - ROWS**2 - COLUMNS**2, 0)).astype(np.float32)


def test_marks_stay_inside_and_are_the_same_again() -> None:
    shares = []
    for seed in range(30):
        ink = random_marks(DEPTH, BALL, np.random.default_rng(seed))
        assert np.array_equal(ink, random_marks(DEPTH, BALL, np.random.default_rng(seed)))
        assert ink.dtype == np.float32
        assert 0 <= ink.min() <= ink.max() <= 1
        assert not ink[~BALL].any()
        shares.append((ink[BALL] > 0.3).mean())
    assert 0.02 < np.median(shares) < 0.4


def test_lines_along_a_form_are_closer_where_it_turns_away() -> None:
    """Lines of equal depth, 10 apart, on a slope of 2: 5 pixels apart on the paper."""
    distance = marks._to_lines(2 * COLUMNS, 10)
    expected = np.abs((COLUMNS + 2.5) % 5 - 2.5)
    assert np.allclose(distance, expected, atol=1e-4)


def test_no_line_runs_along_a_step() -> None:
    stepped = np.where(COLUMNS < 0, 0, 40).astype(np.float32)
    distance = marks._to_lines(stepped + COLUMNS, 10)
    assert np.isinf(distance[:, 59:61]).all()
    assert np.isfinite(distance[:, :58]).all()


def test_marks_change_the_ink_and_not_the_truth(monkeypatch: pytest.MonkeyPatch) -> None:
    normals = np.where(BALL[..., None], np.dstack([COLUMNS, -ROWS, DEPTH]) / 50 * 127, 0)
    triple = Triple(
        drawings=np.zeros((3, *BALL.shape), np.uint8),
        mask=BALL,
        normals=normals.astype(np.int8),
        depth=(DEPTH * DEPTH_STEPS).astype(np.uint16),
        occlusion=np.zeros(BALL.shape, np.uint8),
    )
    monkeypatch.setattr(
        character_batches, "random_marks", lambda depth, mask, rng: mask.astype(np.float32)
    )
    found = {}
    for share in (-1.0, 2.0):
        monkeypatch.setattr(character_batches, "MARKED", share)
        found[share] = place_on_canvas(triple, np.random.default_rng(4), [96])
    plain, marked = found.values()
    assert not plain.inks.any()
    assert (marked.inks[:, marked.mask] > 250).mean() > 0.95
    for name in ("mask", "normals", "shape", "auxiliary"):
        assert np.array_equal(getattr(plain, name), getattr(marked, name))
