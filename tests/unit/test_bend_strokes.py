"""Strokes that say that a part is round or hollow: where they reach the network, and what for."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from lampblack.cache import ArrayCache
from lampblack.choices import Brush, PipelineOptions
from lampblack.corrected import bend_strokes
from lampblack.drawing import decompose_drawing, load_picture
from lampblack.normals.bend_strokes import (
    HOLLOW,
    ROUND,
    STRENGTH,
    BendStroke,
    cells_along,
    stroke_cells,
)
from lampblack.normals.character import Canvas
from lampblack.normals.predict import NormalPredictor
from lampblack.normals.prediction import Prediction
from lampblack.normals.silhouette import inflated_normals
from lampblack.preparation import prepare
from lampblack.scene import DepthHint, DepthPoint, DepthStroke
from lampblack.surface_maker import SurfaceMaker
from lampblack_research.evaluation.metrics import bend
from support.drawings import draw_ball
from support.paths import ROOT

SIDE = 160


def stroke(brush: Brush, *points: tuple[float, float]) -> DepthStroke:
    return DepthStroke(1, tuple(DepthPoint(*p) for p in points), brush)


def bowl() -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """Lines and mask of two circles, one in the other: a bowl from above, or a button."""
    picture = Image.new("L", (SIDE, SIDE))
    pen = ImageDraw.Draw(picture)
    pen.ellipse((10, 10, SIDE - 10, SIDE - 10), fill=255)
    mask = np.asarray(picture) > 127
    lines = Image.new("L", (SIDE, SIDE))
    pen = ImageDraw.Draw(lines)
    for inset in (10, 40):
        pen.ellipse((inset, inset, SIDE - inset, SIDE - inset), outline=255, width=3)
    return np.asarray(lines, np.float32) / 255, mask


def test_a_stroke_marks_the_cells_under_it() -> None:
    canvas = Canvas((64, 96), (32, 64))  # the box is at (16, 16), twice as large as the drawing
    strokes = [BendStroke(np.array([[0, 0], [31.9, 0]], np.float32), HOLLOW)]
    strokes += [BendStroke(np.array([[4, 8]], np.float32), ROUND)]
    cells = stroke_cells(strokes, (16, 32), canvas)
    assert cells is not None
    expected = np.zeros((16, 24), np.float32)
    expected[3:6, 3:21] = HOLLOW * STRENGTH
    expected[7:10, 5:8] = ROUND * STRENGTH
    assert np.array_equal(cells, expected)
    assert stroke_cells([], (16, 32), canvas) is None
    far = BendStroke(np.array([[-1e12, 8], [1e12, 8]], np.float32), ROUND)  # of a hostile scene
    across = stroke_cells([far], (16, 32), canvas)
    assert across is not None
    assert (across[7:10] == ROUND * STRENGTH).all()
    beyond = stroke_cells([BendStroke(np.full((2, 2), 1e6, np.float32), ROUND)], (16, 32), canvas)
    assert beyond is not None
    assert not beyond.any()


def test_a_line_has_no_gaps() -> None:
    rows, columns = cells_along(np.array([[0.5, 0.5], [9.5, 4.5], [9.5, 9.5]]))
    steps = np.abs(np.diff(rows)), np.abs(np.diff(columns))
    assert max(steps[0].max(), steps[1].max()) <= 1
    assert (rows[0], columns[0], rows[-1], columns[-1]) == (0, 0, 9, 9)


def test_only_round_and_hollow_are_told_to_the_network() -> None:
    hints = [stroke("bump", (1, 1)), stroke("hollow", (3, 4), (5, 6)), stroke("round", (7, 8))]
    found = bend_strokes([*hints, DepthHint(1, (DepthPoint(1, 1),)), stroke("hollow")])
    assert [(told.bend, told.points.tolist()) for told in found] == [
        (HOLLOW, [[3, 4], [5, 6]]),
        (ROUND, [[7, 8]]),
    ]


def test_strokes_go_where_the_character_goes() -> None:
    """A character elsewhere on the canvas, told the same, has the same normals."""
    predictor = NormalPredictor()
    lines, mask = bowl()
    told = BendStroke(np.array([[60, 80], [100, 80]], np.float32), HOLLOW)
    found = predictor.predict(lines, mask, quick=True, strokes=[told]).normals
    moved = [np.pad(plane, ((7, 3), (20, 4))) for plane in (lines, mask)]
    elsewhere = predictor.predict(*moved, quick=True, strokes=[told.moved(20, 7)]).normals
    assert np.array_equal(elsewhere[7:-3, 20:-4], found)
    cut = [plane[:, 60:] for plane in (lines, mask)]
    assert np.isfinite(predictor.predict(*cut, strokes=[told.moved(-60, 0)]).normals).all()


def test_a_stroke_across_the_belly_decides_how_it_bends_there() -> None:
    predictor = NormalPredictor()
    drawing = decompose_drawing(load_picture(ROOT / "examples" / "character.png"))
    across = np.array([[430, 640], [560, 640]], np.float32)
    before = predictor.predict(drawing.lines, drawing.mask).normals
    hollow, rounded = (
        predictor.predict(drawing.lines, drawing.mask, strokes=[BendStroke(across, said)]).normals
        for said in (HOLLOW, ROUND)
    )
    place = np.s_[630:650, 430:560]
    assert (bend(hollow, drawing.mask)[place] < 0).mean() > 0.8
    assert (bend(rounded, drawing.mask)[place] > 0).mean() > 0.8
    # The rest of the character stays as it was: the head has nothing to do with it.
    assert np.abs(hollow - before)[:400].max() < 0.2


def test_what_is_told_makes_another_surface_and_is_taken_back(tmp_path: Path) -> None:
    surfaces = SurfaceMaker(ArrayCache(tmp_path), PipelineOptions(), _Told())
    drawing = decompose_drawing(draw_ball(96))
    before = prepare(surfaces, drawing, with_normals=True)
    hint = stroke("hollow", (40, 48), (56, 48))
    told = prepare(surfaces, drawing, hints=[hint], with_normals=True)
    assert told.normals is not None
    assert before.normals is not None
    assert told.height[48, 48] < before.height[48, 48] - 5
    assert told.normals[48, 20, 0] == pytest.approx(-before.normals[48, 20, 0], abs=1e-6)
    again = prepare(surfaces, drawing, with_normals=True)
    assert np.array_equal(again.height, before.height)


class _Told:
    """Sees every drawing round, but hollow if it is told so."""

    identity = "told"

    def predict(
        self,
        lines: NDArray[np.float32],
        mask: NDArray[np.bool_],
        *,
        strokes: Sequence[BendStroke] = (),
        **_: object,
    ) -> Prediction:
        sign = HOLLOW if any(told.bend == HOLLOW for told in strokes) else ROUND
        return Prediction(inflated_normals(mask) * np.array([sign, sign, 1], np.float32))
