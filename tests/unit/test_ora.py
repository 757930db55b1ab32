"""OpenRaster drawings: layers as they lie, and what a stranger's file may not do."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lampblack.drawing import read_picture
from lampblack.errors import LampblackWarning, ProjectError
from lampblack.project import blend as blends
from lampblack.project import read_project
from lampblack.project.blend import Blend
from lampblack.project.shot import ProjectShot
from lampblack.project.stack import Roles
from lampblack.shot import MAX_LAYERS
from support.layered import apart
from support.paths import ROOT
from support.projects import png


def square(colour: tuple[int, int, int], side: int = 10) -> np.ndarray:
    return np.full((side, side, 4), (*colour, 255), np.uint8)


RED, GREEN, BLUE = (square(c) for c in ((200, 0, 0), (0, 200, 0), (0, 0, 200)))


def write_ora(folder: Path, stack: str, size: str = 'w="31" h="20"') -> Path:
    path = folder / "hero.ora"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("mimetype", "image/openraster")
        archive.writestr("stack.xml", f"<image {size}><stack>{stack}</stack></image>")
        for name, picture in (("r", RED), ("g", GREEN), ("b", BLUE)):
            archive.writestr(f"data/{name}.png", png(picture))
    return path


def shot_of(path: Path, roles: Roles | None = None) -> ProjectShot:
    return ProjectShot(*read_project(path), roles or {})


def test_layers_lie_where_they_lay_the_first_on_top(tmp_path: Path) -> None:
    stack = (
        '<layer name="line" src="data/r.png" x="4" y="5"/>'
        '<stack x="2" y="1" opacity="0.5"><layer name="fill" src="data/g.png" x="8" y="4"/></stack>'
        '<layer name="paper" src="data/b.png" x="-6" visibility="hidden"/>'
    )
    shot = shot_of(write_ora(tmp_path, stack))
    (frame,) = shot.frames
    assert (frame.name, shot.canvas.width, shot.canvas.height) == ("hero.0001.png", 31, 20)
    expected = np.zeros((20, 31, 4), np.uint8)
    expected[5:15, 10:20] = 0, 200, 0, 128
    expected[5:15, 4:14] = RED
    assert np.array_equal(shot.cel(frame).pixels, expected)


def test_roles_are_those_of_any_project(tmp_path: Path) -> None:
    stack = '<layer name="hero" src="data/r.png"/><layer name="sky" src="data/b.png" x="20"/>'
    shot = shot_of(write_ora(tmp_path, stack), {"hero": "character"})
    lit = shot.cel(shot.frames[0]).pixels
    assert not lit[:, 20:].any()
    finished = shot.finish(shot.frames[0], lit)
    assert tuple(finished[0, 25]) == (0, 0, 200, 255)


@pytest.mark.parametrize("source", ["../r.png", "data/../../r.png", "/etc/passwd"])
def test_names_that_lead_elsewhere_are_refused(tmp_path: Path, source: str) -> None:
    shot = shot_of(write_ora(tmp_path, f'<layer src="{source}"/>'))
    with pytest.raises(ProjectError, match="outside its own folder"):
        shot.cel(shot.frames[0])


@pytest.mark.parametrize(
    ("stack", "size", "words"),
    [
        ("", 'w="900000" h="2"', "pixels"),
        ("", "", "pixels"),
        ("", 'w="5" h="5"', "no layer with a picture"),
        ('<layer src="data/r.png" x="1e9"/>', 'w="5" h="5"', "not possible"),
        ('<layer src="data/r.png"/>' * 1001, 'w="5" h="5"', "1000 layers"),
        ("<stack>" * 60 + "</stack>" * 60, 'w="5" h="5"', "deep"),
        ("<layer", 'w="5" h="5"', "valid XML"),
    ],
)
def test_descriptions_that_make_no_sense_are_told(
    tmp_path: Path, stack: str, size: str, words: str
) -> None:
    with pytest.raises(ProjectError, match=words):
        shot_of(write_ora(tmp_path, stack, size))


def test_other_ways_of_blending_are_told(tmp_path: Path) -> None:
    stack = '<layer name="shade" src="data/r.png" composite-op="krita:bumpmap"/>'
    with pytest.warns(LampblackWarning, match="shade"):
        shot_of(write_ora(tmp_path, stack))


SHADE, FIGURE = (
    '<layer name="shade" src="data/b.png" x="5" y="5" composite-op="{}"{}/>',
    '<layer name="figure" src="data/r.png" x="0" y="0"/>',
)


def painted(folder: Path, stack: str) -> np.ndarray:
    shot = shot_of(write_ora(folder, stack))
    picture = shot.cel(shot.frames[0]).pixels
    return picture.astype(int)


@pytest.mark.parametrize("isolation", ["", ' isolation="isolate"', ' isolation="auto"'])
def test_a_clipped_layer_shows_only_on_what_is_below(tmp_path: Path, isolation: str) -> None:
    inside = SHADE.format("svg:src-atop", "") + FIGURE
    picture = painted(tmp_path, f"<stack{isolation}>{inside}</stack>")
    expected = np.zeros((20, 31, 4), int)
    expected[:10, :10] = RED[0, 0]
    expected[5:10, 5:10] = BLUE[0, 0]
    assert np.array_equal(picture, expected)


def test_isolation_decides_what_a_clipped_layer_is_clipped_to(tmp_path: Path) -> None:
    """In an isolated group of its own there is nothing below it."""
    shade = SHADE.format("svg:src-atop", "")
    alone = painted(tmp_path, f'<stack isolation="isolate">{shade}</stack>{FIGURE}')
    assert alone[7, 7].tolist() == RED[0, 0].tolist()
    passed = painted(tmp_path, f'<stack isolation="auto">{shade}</stack>{FIGURE}')
    assert passed[7, 7].tolist() == BLUE[0, 0].tolist()


def test_the_opacity_of_a_group_is_that_of_the_whole(tmp_path: Path) -> None:
    """What one of its layers hides does not show through."""
    over = SHADE.format("svg:src-over", "")
    picture = painted(tmp_path, f'<stack opacity="0.5">{over}{FIGURE}</stack>')
    assert picture[7, 7].tolist() == [0, 0, 200, 128]


def blended(below: np.ndarray, above: np.ndarray, mode: Blend, opacity: float, **how: Any) -> Any:
    """Of bytes."""
    floats = (np.divide(picture, 255, dtype=np.float32) for picture in (below, above))
    return np.rint(blends.blended(*floats, mode, opacity, **how) * 255).astype(np.uint8)


UNDER, OVER = (80, 220, 0, 255), (200, 100, 0, 255)
MIXED = {  # of 200 and 100 over 80 and 220, by hand
    "multiply": (200 * 80 / 255, 100 * 220 / 255),
    "screen": (200 + 80 - 200 * 80 / 255, 100 + 220 - 100 * 220 / 255),
    "overlay": (2 * 200 * 80 / 255, 255 - 2 * 155 * 35 / 255),
    "hard-light": (255 - 2 * 55 * 175 / 255, 2 * 100 * 220 / 255),
    "darken": (80, 100),
    "lighten": (200, 220),
    "difference": (120, 120),
    "color-dodge": (255, 255),
    "color-burn": (255 - 175 * 255 / 200, 255 - 35 * 255 / 100),
    "plus": (255, 255),
}


@pytest.mark.parametrize("mode", MIXED)
def test_colours_are_blended_as_w3c_says(mode: Any) -> None:
    below, above = (
        np.full((1, 1, 4), c, np.uint8) for c in ((80, 220, 0, 255), (200, 100, 0, 255))
    )
    result = blended(below, above, mode, 1)[0, 0]
    assert np.abs(result[:2] - np.array(MIXED[mode])).max() <= 0.51
    half = blended(below, above, mode, 0.5)[0, 0]
    if mode != "plus":
        assert np.abs(half[:2] - np.mean([MIXED[mode], UNDER[:2]], axis=0)).max() <= 0.51
    nothing = np.zeros_like(below)
    assert np.array_equal(blended(nothing, above, mode, 1), above)
    assert np.array_equal(blended(below, nothing, mode, 1), below)
    clipped = blended(nothing, above, mode, 1, clipped=True)
    assert not clipped[..., 3].any()


def test_hue_and_saturation_keep_the_luma_below() -> None:
    rng = np.random.default_rng(3)
    below, above = (rng.integers(0, 256, (40, 40, 4)).astype(np.uint8) for _ in "ab")
    below[..., 3] = above[..., 3] = 255
    luma = np.array([0.3, 0.59, 0.11])
    modes: tuple[Blend, ...] = ("hue", "saturation", "color")
    for mode in modes:
        result = blended(below, above, mode, 1)
        assert np.abs(result[..., :3] @ luma - below[..., :3] @ luma).max() < 1
    result = blended(below, above, "luminosity", 1)
    assert np.abs(result[..., :3] @ luma - above[..., :3] @ luma).max() < 1


def test_masks_cut_what_is_below() -> None:
    below, above = np.full((1, 1, 4), (9, 8, 7, 200), np.uint8), np.full((1, 1, 4), 102, np.uint8)
    assert blended(below, above, "dst-in", 1)[0, 0].tolist() == [9, 8, 7, 80]
    assert blended(below, above, "dst-out", 1)[0, 0].tolist() == [9, 8, 7, 120]
    assert blended(below, above, "dst-atop", 1)[0, 0, 3] == 102


def test_a_file_that_krita_wrote_looks_as_in_krita() -> None:
    path = ROOT / "tests/data/layers/krita.ora"
    with zipfile.ZipFile(path) as archive:
        merged = read_picture(io.BytesIO(archive.read("mergedimage.png")), "merged")
    shot = shot_of(path)
    assert apart(shot.cel(shot.frames[0]).pixels, merged).max() <= 2


@pytest.mark.parametrize("mypaint", [False, True])
def test_adding_is_light_in_mypaint_and_a_blend_elsewhere(tmp_path: Path, mypaint: bool) -> None:
    """They differ where a bright layer is translucent."""
    glow = '<layer name="glow" src="data/r.png" opacity="0.5" composite-op="svg:plus"/>'
    named = ' xmlns:mypaint="http://mypaint.org/ns/openraster"' if mypaint else ""
    path = write_ora(tmp_path, glow + FIGURE, f'w="31" h="20"{named}')
    shot = shot_of(path)
    red = int(shot.cel(shot.frames[0]).pixels[2, 2, 0])
    assert red == (255 if mypaint else round((200 + 255) / 2))


def test_a_clipped_layer_goes_with_what_it_is_clipped_to(tmp_path: Path) -> None:
    stack = SHADE.format("svg:src-atop", "") + FIGURE + '<layer name="paper" src="data/g.png"/>'
    shot = shot_of(write_ora(tmp_path, stack), {"figure": "character"})
    lit = shot.cel(shot.frames[0]).pixels
    assert lit[7, 7].tolist() == BLUE[0, 0].tolist()
    shot = shot_of(write_ora(tmp_path, stack), {"figure": "character", "shade": "background"})
    assert shot.cel(shot.frames[0]).pixels[7, 7].tolist() == RED[0, 0].tolist()
    finished = shot.finish(shot.frames[0], shot.cel(shot.frames[0]).pixels)
    assert finished[7, 7].tolist() == BLUE[0, 0].tolist()


def test_a_layer_that_touches_up_is_no_body(tmp_path: Path) -> None:
    stack = '<layer name="arm" src="data/g.png" x="12" y="6"/>' + SHADE.format("svg:multiply", "")
    shot = shot_of(write_ora(tmp_path, stack + FIGURE))
    figure, arm = shot.cel(shot.frames[0]).layers
    assert (figure.name, arm.name) == ("figure", "arm")
    assert figure.placed((31, 20))[7, 7].tolist() == [0, 0, 0, 255]


def test_text_and_vectors_are_left_out(tmp_path: Path) -> None:
    with pytest.warns(LampblackWarning, match="'title' are text or vectors"):
        picture = painted(tmp_path, '<layer name="title" src="data/layer1.svg"/>' + FIGURE)
    assert picture[..., 3].sum() == 100 * 255


def test_the_same_file_has_the_same_drawing(tmp_path: Path) -> None:
    """Whatever else was read before: finished pictures are known by it."""
    path = write_ora(tmp_path, f"<stack>{SHADE.format('svg:screen', '')}{FIGURE}</stack>")
    first, second = shot_of(path), shot_of(path)
    assert first.frames[0].drawing == second.frames[0].drawing


def test_lit_layers_are_kept_apart(tmp_path: Path) -> None:
    stack = (
        '<layer name="line" src="data/r.png" x="4" y="5"/>'
        '<stack x="2" y="1" opacity="0.5"><layer name="fill" src="data/g.png" x="8" y="4"/></stack>'
        '<layer name="away" src="data/b.png" x="-10"/>'
        '<layer name="hidden" src="data/b.png" visibility="hidden"/>'
    )
    path = write_ora(tmp_path, stack)
    shot = shot_of(path, {"line": "line"} | dict.fromkeys(("fill", "away"), "character"))
    cel = shot.cel(shot.frames[0])
    assert [(layer.name, layer.left, layer.top) for layer in cel.layers] == [
        ("fill", 10, 5),
        ("line", 4, 5),
    ]
    assert [layer.line for layer in cel.layers] == [False, True]
    assert (cel.layers[0].pixels == (0, 200, 0, 128)).all()
    assert (cel.layers[1].pixels == (200, 0, 0, 255)).all()
    assert shot_of(path, {"fill": "character"}).cel(shot.frames[0]).layers == ()


def test_very_many_layers_are_lit_as_one(tmp_path: Path) -> None:
    for count in (MAX_LAYERS, MAX_LAYERS + 1):
        stack = "".join(f'<layer name="{n}" src="data/r.png" x="{n}"/>' for n in range(count))
        shot = shot_of(write_ora(tmp_path, stack))
        assert len(shot.cel(shot.frames[0]).layers) == (count if count == MAX_LAYERS else 0)
