"""OpenRaster drawings: layers as they lie, and what a stranger's file may not do."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest

from lampblack.errors import LampblackWarning, ProjectError
from lampblack.project import read_project
from lampblack.project.shot import ProjectShot
from lampblack.project.stack import Roles
from lampblack.shot import MAX_LAYERS
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
        ("", 'w="5" h="5"', "lit"),
        ('<layer src="data/r.png" x="1e9"/>', 'w="5" h="5"', "no sense"),
        ('<layer src="data/r.png"/>' * 1001, 'w="5" h="5"', "1000 layers"),
        ("<stack>" * 60 + "</stack>" * 60, 'w="5" h="5"', "deep"),
        ("<layer", 'w="5" h="5"', "sound XML"),
    ],
)
def test_descriptions_that_make_no_sense_are_told(
    tmp_path: Path, stack: str, size: str, words: str
) -> None:
    with pytest.raises(ProjectError, match=words):
        shot_of(write_ora(tmp_path, stack, size))


def test_other_ways_of_blending_are_told(tmp_path: Path) -> None:
    stack = '<layer name="shade" src="data/r.png" composite-op="svg:multiply"/>'
    with pytest.warns(LampblackWarning, match="shade"):
        shot_of(write_ora(tmp_path, stack))


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
