"""Taking drawings apart: character, line, fill and palette, on art drawn here by formula."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from scipy import ndimage

from lampblack.drawing import Drawing, character_mask, decompose_drawing
from lampblack.drawing.morphology import near
from lampblack.errors import DrawingError, LampblackWarning

SIZE = 240
FINE = 4
Picture = NDArray[np.uint8]


def grid() -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """x and y of every fine sample, in pixels."""
    step = (np.arange(SIZE * FINE) + 0.5) / FINE
    across, down = np.meshgrid(step, step)
    return across, down


def disc(x: float, y: float, radius: float) -> NDArray[np.bool_]:
    across, down = grid()
    return np.asarray(np.hypot(across - x, down - y) < radius)


def ring(x: float, y: float, radius: float, width: float) -> NDArray[np.bool_]:
    return disc(x, y, radius + width / 2) & ~disc(x, y, radius - width / 2)


def paint(*layers: tuple[NDArray[np.bool_], tuple[int, int, int]]) -> Picture:
    """Anti-aliased shapes on transparency, straight alpha."""
    colour = np.zeros((SIZE * FINE, SIZE * FINE, 3))
    alpha = np.zeros((SIZE * FINE, SIZE * FINE))
    for shape, paint_colour in layers:
        colour[shape] = paint_colour
        alpha[shape] = 1
    blocks = (SIZE, FINE, SIZE, FINE)
    cover = alpha.reshape(blocks).mean(axis=(1, 3))
    summed = colour.reshape(*blocks, 3).mean(axis=(1, 3))
    straight = summed / np.maximum(cover, 1e-6)[..., None]
    return np.asarray(np.rint(np.dstack([straight, cover * 255])), np.uint8)


def on_paper(picture: Picture, paper: tuple[int, int, int] = (255, 255, 255)) -> Picture:
    alpha = picture[..., 3:] / 255
    blend = picture[..., :3] * alpha + np.array(paper) * (1 - alpha)
    return np.asarray(np.rint(np.dstack([blend, np.full(alpha.shape[:2], 255)])), np.uint8)


def recomposed(drawing: Drawing, paper: tuple[int, int, int]) -> NDArray[np.float64]:
    ink, cover = drawing.ink[..., None], drawing.coverage[..., None]
    character = ink * drawing.ink_colour + (1 - ink) * drawing.albedo
    return np.asarray((cover * character + (1 - cover) * np.array(paper) / 255) * 255)


def outlined(ink: tuple[int, int, int] = (0, 0, 0), width: float = 5) -> Picture:
    """A two-coloured body with an outline, an inner line and a whisker."""
    across, down = grid()
    right = disc(120, 120, 80) & (across > 120)
    whisker = (abs(down - 60) < 2) & (across > 178) & (across < 230)
    inner = ring(120, 120, 40, width)
    return paint(
        (disc(120, 120, 80), (230, 180, 60)),
        (right, (60, 160, 220)),
        (inner, ink),
        (ring(120, 120, 80, width), ink),
        (whisker, ink),
    )


PAPERS = [None, (255, 255, 255), (190, 215, 240)]


@pytest.mark.parametrize("paper", PAPERS)
def test_layers_give_the_drawing_back(paper: tuple[int, int, int] | None) -> None:
    art = outlined()
    drawing = decompose_drawing(art if paper is None else on_paper(art, paper))
    paper = paper or (255, 255, 255)
    error = np.abs(recomposed(drawing, paper) - on_paper(art, paper)[..., :3]).max(axis=2)
    assert np.mean(error[drawing.mask] <= 2) > 0.999
    assert np.mean(error <= 2) > 0.998


@pytest.mark.parametrize("paper", PAPERS)
@pytest.mark.parametrize(("ink", "width"), [((0, 0, 0), 5), ((90, 30, 20), 2), ((0, 0, 0), 9)])
def test_mask_ends_exactly_at_the_line(
    paper: tuple[int, int, int] | None, ink: tuple[int, int, int], width: float
) -> None:
    art = outlined(ink, width)
    truth = art[..., 3] >= 128
    mask = character_mask(art if paper is None else on_paper(art, paper))
    assert np.count_nonzero(mask != truth) <= 0.001 * np.count_nonzero(truth)


@pytest.mark.parametrize("paper", PAPERS)
def test_ink_is_the_line_and_leaves_clean_fill_beneath(
    paper: tuple[int, int, int] | None,
) -> None:
    art = outlined()
    drawing = decompose_drawing(art if paper is None else on_paper(art, paper))
    line = paint((ring(120, 120, 80, 5) | ring(120, 120, 40, 5), (0, 0, 0)))[..., 3] / 255
    body = paint((disc(120, 120, 78), (0, 0, 0)))[..., 3] == 255
    # Where the two fills meet, a pixel is a blend of both with no ink in it.
    seam = np.zeros_like(body)
    seam[:, 116:124] = True
    inside = body & ~seam
    assert np.abs(drawing.ink - line)[inside].max() < 0.03
    left = inside & (np.arange(SIZE) < 120)
    assert np.abs(drawing.albedo[left] * 255 - (230, 180, 60)).max() < 3
    right = inside & (np.arange(SIZE) > 120)
    assert np.abs(drawing.albedo[right] * 255 - (60, 160, 220)).max() < 3


def test_no_fringe_when_the_fill_is_lit_differently() -> None:
    drawing = decompose_drawing(outlined())
    lit = np.array([1, 0, 1], np.float32)
    character = drawing.ink[..., None] * drawing.ink_colour + (1 - drawing.ink[..., None]) * lit
    line = paint((ring(120, 120, 80, 5) | ring(120, 120, 40, 5), (0, 0, 0)))[..., 3] / 255
    body = paint((disc(120, 120, 78), (0, 0, 0)))[..., 3] == 255
    expected = (1 - line)[..., None] * lit
    assert np.abs(character - expected)[body].max() < 0.04


def test_whisker_outside_the_body_is_ink() -> None:
    drawing = decompose_drawing(outlined())
    assert drawing.mask[59:61, 210:228].all()
    assert drawing.ink[59:61, 210:228].min() > 0.9


def test_albedo_goes_on_past_the_mask() -> None:
    drawing = decompose_drawing(outlined())
    rim = ndimage.binary_dilation(drawing.mask, iterations=4) & ~drawing.mask
    assert drawing.albedo[rim].max(axis=1).min() > 0.5
    assert drawing.lines[~drawing.mask].max() == 0
    assert (drawing.labels[~drawing.mask] == -1).all()
    assert (drawing.labels[drawing.mask] >= 0).all()


def test_types_and_shapes_are_as_promised() -> None:
    drawing = decompose_drawing(outlined()[:, :200])
    assert drawing.size == (200, SIZE)
    for name in ("coverage", "lines", "ink"):
        plane = getattr(drawing, name)
        assert plane.shape == (SIZE, 200)
        assert plane.dtype == np.float32
        assert plane.min() >= 0
        assert plane.max() <= 1
    for name in ("ink_colour", "albedo"):
        assert getattr(drawing, name).shape == (SIZE, 200, 3)
        assert getattr(drawing, name).dtype == np.float32
    assert drawing.labels.dtype == np.int16
    assert drawing.mask.dtype == np.bool_


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


def test_grainy_scan() -> None:
    rng = np.random.default_rng(0)
    clean = on_paper(outlined(), (245, 243, 238)).astype(float)
    clean[..., :3] += rng.normal(0, 3, (SIZE, SIZE, 1))
    scan = np.rint(clean.clip(0, 255)).astype(np.uint8)
    drawing = decompose_drawing(scan)
    truth = outlined()[..., 3] >= 128
    assert np.mean(drawing.mask != truth) < 0.002
    assert len(drawing.palette.swatches) <= 4


def test_palette_keys_are_the_exact_flat_colours() -> None:
    drawing = decompose_drawing(outlined())
    counts = [swatch.pixels for swatch in drawing.palette.swatches]
    assert {swatch.colour for swatch in drawing.palette.swatches} == {"#e6b43c", "#3ca0dc"}
    assert counts == sorted(counts, reverse=True)
    assert sum(counts) == drawing.mask.sum()
    for index, swatch in enumerate(drawing.palette.swatches):
        assert np.count_nonzero(drawing.labels == index) == swatch.pixels


def test_painted_art_is_grouped_with_a_warning() -> None:
    rng = np.random.default_rng(1)
    art = paint((disc(120, 120, 100), (0, 0, 0)))
    waves = ndimage.gaussian_filter(rng.normal(size=(SIZE, SIZE, 3)), (9, 9, 0))
    waves = (waves - waves.min()) / (waves.max() - waves.min())
    art[..., :3] = np.rint(waves * 255)
    with pytest.warns(LampblackWarning, match="very many colours"):
        drawing = decompose_drawing(art)
    assert 2 <= len(drawing.palette.swatches) <= 64


def test_overrides() -> None:
    art = outlined()
    mask = np.zeros_like(art)
    mask[..., 3] = 255
    mask[50:120, 50:190, :3] = 255
    ink = np.full_like(art, 255)
    ink[80:90, 60:180, :3] = 0
    drawing = decompose_drawing(art, mask=mask, ink=ink)
    expected = np.zeros((SIZE, SIZE), bool)
    expected[50:120, 50:190] = True
    np.testing.assert_array_equal(drawing.mask, expected)
    assert (drawing.ink[80:90, 60:180] == 1).all()
    assert drawing.ink.sum() == pytest.approx(10 * 120)
    with pytest.raises(DrawingError, match="mask picture"):
        decompose_drawing(art, mask=mask[:100])
    with pytest.raises(DrawingError, match="nothing inside"):
        decompose_drawing(art, mask=np.dstack([np.zeros_like(art[..., :3]), mask[..., 3]]))


@pytest.mark.parametrize("shape", [(1, 1), (1, 300), (300, 1), (64, 64)])
@pytest.mark.parametrize("value", [(0, 0, 0, 0), (255, 255, 255, 255), (9, 9, 9, 255)])
def test_nothing_drawn_is_an_error(shape: tuple[int, int], value: tuple[int, ...]) -> None:
    with pytest.raises(DrawingError):
        decompose_drawing(np.full((*shape, 4), value, np.uint8))


def test_specks_are_an_error() -> None:
    art = np.zeros((50, 50, 4), np.uint8)
    art[20:23, 20:23] = 255
    with pytest.raises(DrawingError, match="9 pixels"):
        decompose_drawing(art)
    with pytest.raises(DrawingError):
        decompose_drawing(np.zeros((0, 5, 4), np.uint8))


@pytest.mark.parametrize("shape", [(1, 40), (40, 1), (2, 30), (5, 5), (17, 4)])
def test_tiny_pictures_do_not_crash(shape: tuple[int, int]) -> None:
    rng = np.random.default_rng(2)
    for _ in range(10):
        art = rng.integers(0, 256, (*shape, 4)).astype(np.uint8)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", LampblackWarning)
            try:
                drawing = decompose_drawing(art)
            except DrawingError:
                continue
        assert drawing.mask.shape == shape
        assert np.isfinite(drawing.albedo).all()


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
