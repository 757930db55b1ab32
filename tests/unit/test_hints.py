"""Hints of depth follow the character from drawing to drawing."""

from __future__ import annotations

import numpy as np
from PIL import Image
from scipy import ndimage

from lampblack.drawing import Drawing, decompose_drawing
from lampblack.hints import HintedDrawing, carry_hints, hint_frames
from lampblack.normals.temporal.temporal_filter import TemporalFilter
from lampblack.scene import Depth, DepthHint, DepthPoint
from support.paths import ROOT


def character(turned: float = 0.0, shift: tuple[int, int] = (0, 0)) -> Drawing:
    """The example's character on a larger canvas, turned in degrees, then shifted by (x, y)."""
    picture = Image.open(ROOT / "examples" / "character.png").convert("RGBA")
    picture.thumbnail((400, 400))
    canvas = Image.new("RGBA", (560, 560))
    canvas.paste(picture, ((560 - picture.width) // 2, (560 - picture.height) // 2))
    pixels = np.asarray(canvas.rotate(turned, Image.Resampling.BICUBIC))
    return decompose_drawing(ndimage.shift(pixels, (shift[1], shift[0], 0), order=0))


def hint(*points: tuple[float, float], frame: int = 1, front: str = "left") -> DepthHint:
    return DepthHint(frame, tuple(DepthPoint(*p) for p in points), front)  # type: ignore[arg-type]


def test_hints_of_the_same_drawing_stay() -> None:
    here, same = character(), character()
    given = hint((250.0, 280.0), (310.0, 300.0))
    assert carry_hints([HintedDrawing(here, (given,))], same, TemporalFilter()) == (given,)


def test_hints_move_with_the_character() -> None:
    here, there = character(), character(turned=8.0, shift=(22, -9))
    given = hint((250.0, 280.0), (310.0, 300.0))
    (carried,) = carry_hints([HintedDrawing(here, (given,))], there, TemporalFilter())
    angle = np.radians(8.0)
    for before, after in zip(given.points, carried.points, strict=True):
        x, y = before.x - 280, before.y - 280
        expected = (
            280 + np.cos(angle) * x + np.sin(angle) * y + 22,
            280 - np.sin(angle) * x + np.cos(angle) * y - 9,
        )
        assert np.hypot(after.x - expected[0], after.y - expected[1]) < 3
    assert carried.front == "left"


def test_a_drawing_of_something_else_takes_no_hints() -> None:
    disk = np.zeros((560, 560, 4), np.uint8)
    rows, columns = np.mgrid[0:560, 0:560]
    disk[np.hypot(rows - 100, columns - 420) < 60] = (40, 90, 200, 255)
    hinted = HintedDrawing(character(), (hint((250.0, 280.0), (310.0, 300.0)),))
    assert carry_hints([hinted], decompose_drawing(disk), TemporalFilter()) == ()


def test_at_one_place_the_hint_of_the_nearer_frame_counts() -> None:
    here = character()
    near = HintedDrawing(here, (hint((250.0, 280.0), (310.0, 300.0), frame=4, front="right"),))
    far = HintedDrawing(
        here, (hint((252.0, 281.0), (309.0, 300.0)), hint((250.0, 400.0), (300.0, 400.0)))
    )
    carried = carry_hints([near, far], here, TemporalFilter())
    assert [(h.frame, h.front) for h in carried] == [(4, "right"), (1, "left")]
    depth = Depth(hints=(*far.hints, *near.hints, hint((0, 0), frame=300)))
    assert hint_frames(depth, 5) == [4, 1]
    assert hint_frames(depth, 2) == [1, 4]
