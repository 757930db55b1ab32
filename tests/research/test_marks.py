"""Marks that are no edges, and surfaces that are cut along them."""

from __future__ import annotations

import numpy as np
import pytest
from shapes import ball

from lampblack_research.evaluation.depth_meter import DepthMeter
from lampblack_research.evaluation.drawings import TestDrawing
from lampblack_research.evaluation.marks import MARKS, WIDTH, draw_marks, wrongly_cut
from lampblack_research.evaluation.surfaces import Lines, Mask, Normals

SIZE, RADIUS = 300, 120.0


def ball_drawing() -> TestDrawing:
    mask, normals = ball(SIZE, RADIUS)
    depth = np.where(mask, RADIUS * normals[..., 2], np.nan).astype(np.float32)
    lines = np.zeros(mask.shape, np.float32)
    triangle = np.array([[0, 0, -9], [1, 0, -9], [0, 1, -9]], np.float32)
    return TestDrawing("a/ball", lines, mask, normals, depth, triangle, np.array([[0, 1, 2]]))


@pytest.mark.parametrize("kind", MARKS)
def test_marks_are_inside_as_wide_as_they_say_and_the_same_at_every_run(kind: str) -> None:
    drawing = ball_drawing()
    marked = draw_marks(drawing.lines, drawing.mask, kind)
    assert not marked.lines[~drawing.mask].any()
    assert np.array_equal(marked.lines, draw_marks(drawing.lines, drawing.mask, kind).lines)
    assert (marked.lines[marked.centre] >= 0.5).all()
    assert marked.width == pytest.approx(max(1, WIDTH[kind] * 2 * RADIUS), rel=0.02)
    # Ink is its length times its width.
    assert marked.lines.sum() == pytest.approx(marked.centre.sum() * marked.width, rel=0.2)
    assert marked.centre.sum() > 2 * RADIUS
    ink = np.full_like(drawing.lines, 0.7)
    assert draw_marks(ink, drawing.mask, kind).lines.min() == np.float32(0.7)


def test_only_new_steps_along_marks_are_wrong() -> None:
    drawing = ball_drawing()
    marked = draw_marks(drawing.lines, drawing.mask, "hatching")
    smooth = np.nan_to_num(drawing.depth)
    rows, columns = np.indices(smooth.shape)
    cracked = (smooth + 10 * marked.centre).astype(np.float32)
    elsewhere = (smooth + 10 * (rows < 40)).astype(np.float32)
    half = np.where(columns < SIZE / 2, cracked, smooth)
    assert wrongly_cut(marked, smooth, smooth, drawing.depth) == 0
    assert wrongly_cut(marked, cracked, smooth, drawing.depth) == 1
    assert wrongly_cut(marked, cracked, cracked, drawing.depth) == 0
    assert wrongly_cut(marked, elsewhere, smooth, drawing.depth) < 0.05
    assert 0.1 < wrongly_cut(marked, half, smooth, drawing.depth) < 0.9
    plane = np.zeros_like(smooth)
    low, high = (np.where(marked.centre, np.float32(step), 0) for step in (2, 3))
    assert wrongly_cut(marked, low, plane, drawing.depth) == 0  # less than 1 % of the length
    assert wrongly_cut(marked, high, plane, drawing.depth) == 1


def test_a_method_that_takes_ink_for_shape_is_told_from_one_that_does_not() -> None:
    drawing = ball_drawing()

    def steady(lines: Lines, mask: Mask) -> Normals:
        return drawing.truth

    def misled(lines: Lines, mask: Mask) -> Normals:
        aside = np.array([1, 0, 0], np.float32)
        return np.where(lines[..., None] > 0.5, aside, drawing.truth) * mask[..., None]

    meter = DepthMeter(SIZE, marks=True)
    methods = {"steady": steady, "misled": misled}
    normals = {name: method(drawing.lines, drawing.mask) for name, method in methods.items()}
    meter.add(drawing, methods, normals)
    rows = meter.rows()
    assert rows["steady"]["marks_cut"] == rows["steady"]["marks_rise"] == 0
    assert rows["misled"]["marks_rise"] > 1
    assert rows["misled"]["marks_cut"] > 0.02
    assert {f"{kind}_cut" for kind in MARKS} < set(rows["misled"])
    assert "marks_cut" not in rows["true depth"]
