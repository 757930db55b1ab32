"""The character mask: which holes and gaps belong to the character."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.drawing import character_mask, decompose_drawing
from lampblack.drawing.morphology import near
from lampblack.errors import LampblackWarning
from support.shapes import disc, grid, on_paper, paint, recomposed, ring


def test_hole_in_filled_art_stays_a_hole() -> None:
    art = paint((disc(120, 120, 90) & ~disc(150, 120, 20), (200, 120, 60)))
    mask = character_mask(art)
    assert not mask[120, 150]
    assert mask[120, 100]


def inked(size: int, *discs: tuple[int, int, int]) -> NDArray[np.uint8]:
    """(size, size, 4): filled disks, (x, y, radius), each with a dark line of 4 pixels."""
    art = np.zeros((size, size, 4), np.uint8)
    rows, columns = np.mgrid[:size, :size] + 0.5
    for x, y, radius in discs:
        distance = np.hypot(columns - x, rows - y)
        art[distance < radius] = (20, 16, 24, 255)
        art[distance < radius - 4] = (200, 120, 60, 255)
    return art


def hollow(art: NDArray[np.uint8], x: int, y: int, radius: int) -> None:
    """A ring of ink around an empty disk."""
    rows, columns = np.mgrid[: len(art), : len(art)] + 0.5
    distance = np.hypot(columns - x, rows - y)
    art[distance < radius] = (20, 16, 24, 255)
    art[distance < radius - 3] = 0


def test_the_white_of_an_eye_is_lit_as_paper() -> None:
    art = inked(240, (120, 120, 90), (40, 40, 12))
    hollow(art, 90, 100, 13)
    hollow(art, 140, 100, 13)
    art[98:103, 88:93] = (20, 16, 24, 255)  # one has a pupil
    drawing = decompose_drawing(art)
    for column in (84, 140):
        assert drawing.mask[100, column]
        assert drawing.coverage[100, column] == 1
        assert drawing.albedo[100, column] == pytest.approx(1)
        assert drawing.ink[100, column] == 0


def test_a_closed_shape_without_fill_beside_a_filled_figure_is_lit() -> None:
    art = inked(300, (120, 150, 90))
    hollow(art, 250, 220, 40)
    drawing = decompose_drawing(art)
    assert drawing.mask[220, 250]
    assert drawing.albedo[220, 250] == pytest.approx(1)


def test_the_gap_between_an_arm_and_the_body_stays_a_hole() -> None:
    art = inked(240, (120, 120, 90))
    rows, columns = np.mgrid[:240, :240] + 0.5
    gap = (columns > 130) & (rows > 80) & (columns - 130 < (rows - 80) / 3) & (rows < 150)
    art[np.asarray(near(gap, 4))] = (20, 16, 24, 255)
    art[gap] = 0
    assert not character_mask(art)[140, 140]


def test_slivers_between_fill_and_ink_are_covered() -> None:
    """A bucket leaves the soft inner edge of the line translucent: the paper shines through."""
    rows, columns = np.mgrid[:240, :240] + 0.5
    distance = np.hypot(columns - 120, rows - 120)
    line = np.clip(2.2 - abs(distance - 90), 0, 1)
    art = np.dstack([np.full((240, 240, 3), 20), np.rint(255 * line)]).astype(np.uint8)
    art[(line < 0.1) & (distance < 90)] = (90, 140, 200, 255)
    fringe = (art[..., 3] > 0) & (art[..., 3] < 250) & (distance < 89)
    drawing = decompose_drawing(art)
    assert np.count_nonzero(fringe) > 100
    assert (drawing.coverage[fringe] == 1).all()
    outer = (line > 0) & (line < 0.9) & (distance > 90)
    assert drawing.coverage[outer] == pytest.approx(line[outer], abs=0.01)


def line_art(gap: float = 0) -> NDArray[np.bool_]:
    """Ring, inner stroke, and a gap of so many pixels at the right end of the ring."""
    across, down = grid()
    stroke = ring(120, 120, 80, 4) | ring(110, 110, 15, 3)
    return np.asarray(stroke & ~((abs(down - 120) < gap / 2) & (across > 150)))


@pytest.mark.parametrize("gap", [0, 4])
@pytest.mark.parametrize("white", [False, True])
def test_line_art_is_filled_through_small_gaps(gap: float, white: bool) -> None:
    art = paint((line_art(gap), (40, 40, 60)))
    drawing = decompose_drawing(on_paper(art) if white else art)
    truth = paint((disc(120, 120, 82), (0, 0, 0)))[..., 3] >= 128
    away = np.ones_like(truth)
    away[110:130, 190:] = False
    assert (drawing.mask != truth)[away].mean() < 0.001
    assert np.count_nonzero(drawing.mask != truth) < 60
    assert drawing.coverage[140, 140] == 1
    assert drawing.ink[140, 140] == 0
    np.testing.assert_allclose(drawing.albedo[drawing.mask], 1, atol=0.02)
    error = np.abs(recomposed(drawing, (255, 255, 255)) - on_paper(art)[..., :3]).max(axis=2)
    assert np.mean(error <= 2) > 0.999


def test_line_art_cut_by_the_frame_is_closed_there() -> None:
    art = paint((line_art(), (0, 0, 0)))[:140]
    mask = character_mask(art)
    assert mask[139, 120]
    assert not mask[139, 5]


def test_line_art_may_touch_every_edge() -> None:
    art = paint((line_art(), (0, 0, 0)))[40:200, 40:200]
    mask = character_mask(art)
    assert mask[80, 80]
    assert not any((mask[2, 2], mask[2, -3], mask[-3, 2], mask[-3, -3]))


def test_outline_that_cannot_be_closed_warns() -> None:
    art = paint((ring(120, 120, 80, 4) & (grid()[0] > 120), (0, 0, 0)))
    with pytest.warns(LampblackWarning, match="not closed"):
        drawing = decompose_drawing(art)
    assert drawing.mask.any()


def test_enclosed_paper_belongs_to_the_character() -> None:
    art = paint((disc(120, 120, 90), (200, 120, 60)), (disc(150, 100, 20), (255, 255, 255)))
    assert character_mask(on_paper(art))[100, 150]


def test_background_that_is_no_paper_warns() -> None:
    across, _ = grid()
    art = paint((across < 120, (200, 90, 40)), (across >= 120, (40, 90, 200)))
    art[20:60, 20:200, :3] = 0
    art[::7, :, :3] //= 2
    with pytest.warns(LampblackWarning, match="not plain paper"):
        decompose_drawing(art)
