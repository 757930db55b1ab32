"""Drawings with layers, one a frame."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from psd_tools import PSDImage

from lampblack.drawing import load_picture, save_picture
from lampblack.errors import LampblackError, LampblackWarning
from lampblack.finals.resolve import ResolvedShot, resolve_shot
from lampblack.finals.settings import RenderSettings
from support.command_line import Run, files
from support.drawings import draw_ball
from support.krita import keyframes, paint_layer, tiles, write_kra
from support.layered import apart
from support.projects import png, walk

PAPER = (240, 230, 210, 255)


def psd(path: Path, diameter: int) -> Path:
    """A ball in front of paper."""
    made = PSDImage.new("RGBA", (64, 64), depth=8)
    paper = Image.fromarray(np.full((64, 64, 4), PAPER, np.uint8))
    made.create_pixel_layer(paper, name="paper", top=0, left=0)
    ball = Image.fromarray(draw_ball(diameter, canvas=64))
    made.create_pixel_layer(ball, name="ball", top=0, left=0)
    made.save(path)
    return path


def ora(path: Path, diameter: int) -> Path:
    layer = '<layer name="ball" src="data/b.png"/><layer name="paper" src="data/p.png"/>'
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", "image/openraster")
        archive.writestr("stack.xml", f'<image w="64" h="64"><stack>{layer}</stack></image>')
        archive.writestr("data/b.png", png(draw_ball(diameter, canvas=64)))
        archive.writestr("data/p.png", png(np.full((64, 64, 4), PAPER, np.uint8)))
    return path


def resolved(*inputs: Path, **more: object) -> ResolvedShot:
    return resolve_shot(
        RenderSettings(inputs=tuple(map(str, inputs)), output="lit", **more)  # type: ignore[arg-type]
    )


@pytest.mark.parametrize("kind", [psd, ora])
@pytest.mark.parametrize("named", ["folder", "pattern", "files"])
def test_each_file_is_a_frame_with_its_layers(tmp_path: Path, kind, named: str) -> None:  # type: ignore[no-untyped-def]
    ending = f".{kind.__name__}"
    for number in (10, 2, -1):
        kind(tmp_path / f"walk.{number:04d}{ending}", 40 + number)
    (tmp_path / "notes.txt").touch()
    inputs = {
        "folder": [tmp_path],
        "pattern": [tmp_path / f"walk.%04d{ending}"],
        "files": [tmp_path / f"walk.{number:04d}{ending}" for number in (-1, 2, 10)],
    }[named]
    shot = resolved(*inputs, roles={"ball": "character"})
    assert [frame.number for frame in shot.frames] == [-1, 2, 10]
    for frame, diameter in zip(shot.frames, (39, 42, 50), strict=True):
        cel = shot.shot.cel(frame).pixels
        assert not apart(cel, draw_ball(diameter, canvas=64)).any(), "the ball is lit"
        whole = shot.shot.finish(frame, cel)
        assert tuple(whole[0, 0]) == PAPER, "the paper is behind it"


def test_a_folder_of_drawings_with_layers_is_rendered(
    run: Run, tmp_path: Path, unrendered: list[str]
) -> None:
    drawn = tmp_path / "in"
    drawn.mkdir()
    for number in (1, 2):
        psd(drawn / f"Walk.{number:04d}.PSD", 40)
    (drawn / "Walk.0003.psd").write_bytes(b"8BPS damaged")
    out = tmp_path / "lit"
    done = run("render", drawn, "-o", out, "--character", "ball")
    assert done.code == 1
    assert "Walk.0003.psd is damaged" in done.err
    assert files(out) == {"Walk.0001.png", "Walk.0002.png"}
    assert tuple(load_picture(out / "Walk.0001.png")[0, 0]) == PAPER
    assert len(unrendered) == 1, "two files with the same bytes are one drawing"
    assert run("render", drawn, "-o", out, "--character", "ball").code == 1
    assert len(unrendered) == 1, "what is finished is kept"


def test_a_file_that_changes_while_its_shot_is_rendered_is_told(tmp_path: Path) -> None:
    path = psd(tmp_path / "walk.1.psd", 40)
    shot = resolved(tmp_path)
    psd(path, 41)
    with pytest.raises(LampblackError, match="changed while"):
        shot.shot.cel(shot.frames[0])


def test_an_animation_among_them_gives_its_first_frame(tmp_path: Path) -> None:
    layer = paint_layer("ball", "a", keyframes="a.keyframes.xml")
    one, other = (draw_ball(width, canvas=64) for width in (40, 50))
    contents = {
        "a": tiles(one), "a.f1": tiles(other),
        "a.keyframes.xml": keyframes((0, "a", 0, 0), (2, "a.f1", 0, 0)),
    }  # fmt: skip
    for number in (1, 2):
        write_kra(tmp_path / f"walk.{number}.kra", layer, contents, (64, 64))
    shot = resolved(tmp_path)
    assert [frame.number for frame in shot.frames] == [1, 2]
    with pytest.warns(LampblackWarning, match="only the first is used"):
        cel = shot.shot.cel(shot.frames[0])
    assert not apart(cel.pixels, one).any()


def test_what_makes_no_sequence_is_told(tmp_path: Path) -> None:
    drawing, picture = psd(tmp_path / "a.psd", 40), tmp_path / "b.png"
    save_picture(picture, draw_ball(40))
    for inputs in ([drawing, picture], [walk(tmp_path, [1]), drawing]):
        with pytest.raises(LampblackError):
            resolved(*inputs)
    for option in ({"mask": str(picture)}, {"sheet": "2x2"}):
        with pytest.raises(LampblackError, match="Leave out"):
            resolved(drawing, drawing.with_name("a.psd"), **option)
