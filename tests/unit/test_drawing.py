"""Taking drawings apart: character, line, fill and palette, on art drawn here by formula."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from scipy import ndimage

from lampblack.drawing import character_mask, decompose_drawing
from lampblack.errors import DrawingError, LampblackWarning
from support.shapes import SIZE, disc, on_paper, outlined, paint, recomposed, ring

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
