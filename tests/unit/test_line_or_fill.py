"""What of a drawing is line, and what is fill."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from lampblack.drawing import decompose_drawing
from support.shapes import disc, grid, paint, ring


def test_filled_black_is_fill_and_its_border_line() -> None:
    art = paint(
        (disc(120, 120, 90), (240, 200, 160)),
        (disc(120, 130, 30), (0, 0, 0)),
        (ring(120, 120, 90, 4), (0, 0, 0)),
    )
    drawing = decompose_drawing(art)
    assert drawing.ink[110:150, 100:140].max() == 0
    assert {swatch.colour for swatch in drawing.palette.swatches} == {"#f0c8a0", "#000000"}
    assert drawing.lines[130, 120] == 0
    assert drawing.lines[130, 145:155].max() == 1


def test_blots_where_lines_meet_are_line_and_pupils_are_fill() -> None:
    """One would be darker than the lines around it in the shade: a black patch."""
    file = Path(__file__).parents[2] / "examples" / "animation" / "lamplighter.0004.png"
    drawing = decompose_drawing(np.asarray(Image.open(file).convert("RGBA")))
    assert drawing.ink[545:550, 308:318].min() > 0.9
    assert drawing.ink[200:210, 278:286].max() < 0.1
    assert drawing.ink[236:246, 330:342].max() < 0.1


def test_art_without_ink_has_borders_for_lines() -> None:
    across, _ = grid()
    body = disc(120, 120, 80)
    art = paint((body, (250, 150, 150)), (body & (across > 120.5), (200, 90, 110)))
    drawing = decompose_drawing(art)
    assert drawing.ink.max() == 0
    middle = drawing.lines[120]
    assert middle[118:123].max() == 1
    assert 2 <= np.count_nonzero(middle[100:140]) <= 3
    assert 1 <= np.count_nonzero(middle[38:46]) <= 3
    np.testing.assert_allclose(
        drawing.albedo[drawing.mask], art[..., :3][drawing.mask] / 255, atol=1e-6
    )


def zigzag(width: float, turn: float, scale: float) -> NDArray[np.uint8]:
    """A patch with a dark outline, and on it a stroke of one flat blue."""
    fine, side = 4, round(400 * scale)
    picture = Image.new("RGBA", (side * fine, side * fine))
    draw, k = ImageDraw.Draw(picture), fine * scale
    draw.rounded_rectangle(
        [20 * k, 20 * k, 380 * k, 380 * k], 60 * k, (244, 214, 120), (20, 16, 24), int(9 * k)
    )
    way = np.array([(-100, -65), (-20, -65), (-80, 65), (80, 65), (20, -65), (100, -65)])
    angle = np.radians(turn)
    spin = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    points = [tuple(point) for point in ((way @ spin + 200) * k).tolist()]
    draw.line(points, BLUE, int(width * fine), joint="curve")
    return np.array(
        picture.convert("RGBa").resize((side, side), Image.Resampling.BOX).convert("RGBA")
    )


BLUE = (60, 120, 190)


@pytest.mark.parametrize("scale", [1, 1.5])
@pytest.mark.parametrize("width", range(3, 13))
def test_a_stroke_of_one_colour_is_line_or_fill_as_a_whole(width: int, scale: float) -> None:
    """At every slant, and the same at all of them; a width is measured to about 0.3 pixels."""
    shares = []
    for turn in range(0, 90, 15):
        picture = zigzag(width, turn, scale)
        stroke = (np.abs(picture[..., :3].astype(int) - BLUE) < 6).all(axis=2)
        shares.append(float((decompose_drawing(picture).ink[stroke] > 0.5).mean()))
    assert max(shares) < 0.02 or min(shares) > 0.98, shares
