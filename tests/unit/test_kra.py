"""Krita's files: composited as Krita does, and what a stranger's file may not do."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

import numpy as np
import pytest

from lampblack.drawing import read_picture
from lampblack.errors import LampblackWarning, ProjectError
from lampblack.project import read_project
from lampblack.project.kra_tiles import unpacked
from lampblack.project.shot import ProjectShot
from lampblack.project.stack import Roles
from support.krita import group_layer, keyframes, mask, paint_layer, tiles, write_kra
from support.layered import apart, blob
from support.paths import ROOT

SIZE = 96, 72
RED, GREEN, BLUE = (200, 60, 40), (40, 170, 60), (50, 80, 210)


def canvas(picture: np.ndarray, at: tuple[int, int] = (0, 0)) -> np.ndarray:
    whole = np.zeros((SIZE[1], SIZE[0], 4), np.uint8)
    height, width = picture.shape[:2]
    whole[at[1] : at[1] + height, at[0] : at[0] + width] = picture
    return whole


def flat(colour: tuple[int, int, int]) -> np.ndarray:
    return np.full((SIZE[1], SIZE[0], 4), (*colour, 255), np.uint8)


def shot_of(path: Path, roles: Roles | None = None) -> ProjectShot:
    return ProjectShot(*read_project(path), roles or {})


def painted(path: Path, frame: int = 1) -> np.ndarray:
    shot = shot_of(path)
    return shot.cel(shot.frames[frame - 1]).pixels


@pytest.mark.parametrize("name", ["krita.kra", "krita-masks.kra"])
def test_a_file_that_krita_saved_looks_as_in_krita(name: str) -> None:
    path = ROOT / "tests/data/layers" / name
    with zipfile.ZipFile(path) as archive:
        merged = read_picture(io.BytesIO(archive.read("mergedimage.png")), "merged")
    assert apart(painted(path), merged).max() <= 2


@pytest.mark.parametrize("packed", [True, False])
def test_tiles_are_unpacked_at_their_places(packed: bool) -> None:
    rng = np.random.default_rng(2)
    picture = rng.integers(0, 4, (100, 150, 4)).astype(np.uint8)
    data = tiles(picture, packed=packed)
    found = unpacked(data, (150, 100), (0, 0), bytes(4))[..., [2, 1, 0, 3]]
    assert np.array_equal(found, picture)
    moved = unpacked(data, (40, 30), (-70, -20), bytes(4))[..., [2, 1, 0, 3]]
    assert np.array_equal(moved, picture[20:50, 70:110])
    away = unpacked(data, (40, 30), (300, 0), b"\1\2\3\4")
    assert (away == (1, 2, 3, 4)).all()


def test_layers_groups_and_positions(tmp_path: Path) -> None:
    layers = paint_layer("line", "l1", x=4, y=5, opacity=128) + group_layer(
        "hero", paint_layer("body", "l2") + paint_layer("never", "l1", visible=0), opacity=128
    )
    files = {"l1": tiles(canvas(blob(RED, soft=0))), "l2": tiles(flat(GREEN))}
    shot = shot_of(write_kra(tmp_path / "hero.kra", layers, files), {"line": "line"})
    assert [layer.name for layer in read_project(tmp_path / "hero.kra")[0].layers] == [
        "never", "body", "line",
    ]  # fmt: skip
    shot = shot_of(tmp_path / "hero.kra", {"line": "line", "body": "character"})
    picture = shot.cel(shot.frames[0]).pixels
    assert picture[70, 90].tolist() == [*GREEN, 128]
    assert picture[20, 24, 3] == round(255 * (1 - (127 / 255) ** 2))
    assert [layer.line for layer in shot.cel(shot.frames[0]).layers] == [False, True]


def test_inherited_alpha_clips_to_what_is_below_in_the_group(tmp_path: Path) -> None:
    shade = paint_layer("shade", "l1", channelflags="1110")
    layers = group_layer("hero", shade + paint_layer("body", "l2")) + paint_layer("paper", "l3")
    files = {
        "l1": tiles(flat(BLUE)),
        "l2": tiles(canvas(blob(RED, soft=0), (10, 10))),
        "l3": tiles(flat((230, 220, 200))),
    }
    picture = painted(write_kra(tmp_path / "hero.kra", layers, files))
    assert picture[25, 30].tolist() == [*BLUE, 255]
    assert picture[60, 80].tolist() == [230, 220, 200, 255]


def test_masks_of_transparency_hide(tmp_path: Path) -> None:
    grey = np.zeros((SIZE[1], SIZE[0]), np.uint8)
    grey[:36] = 102
    layers = paint_layer("body", "l1", masks=mask("m1"))
    files = {"l1": tiles(flat(RED)), "m1.pixelselection": tiles(grey)}
    alpha = painted(write_kra(tmp_path / "hero.kra", layers, files))[..., 3]
    assert (alpha[:36] == 102).all()
    assert not alpha[36:].any()


def test_a_group_that_passes_gives_its_opacity_to_its_layers(tmp_path: Path) -> None:
    inner = paint_layer("arm", "l1") + paint_layer("body", "l2")
    layers = group_layer("hero", inner, passthrough=1, opacity=128)
    files = {"l1": tiles(flat(RED)), "l2": tiles(flat(BLUE))}
    picture = painted(write_kra(tmp_path / "hero.kra", layers, files))
    assert picture[5, 5, 3] == round(255 * (1 - (127 / 255) ** 2))


def test_an_animation_is_a_shot_of_its_keyframes(tmp_path: Path) -> None:
    layers = paint_layer("hero", "a", keyframes="a.keyframes.xml") + paint_layer("paper", "p")
    files = {
        "a": tiles(canvas(blob(RED, soft=0))),
        "a.f1": tiles(canvas(blob(GREEN, soft=0))),
        "a.keyframes.xml": keyframes((0, "a", 0, 0), (2, "a.f1", 20, 30)),
        "p": tiles(flat((255, 255, 255))),
    }
    path = write_kra(tmp_path / "walk.kra", layers, files, last=4)
    project, _ = read_project(path)
    assert (project.length, project.fps) == (5, 12)
    shot = shot_of(path, {"hero": "character"})
    first, held, moved, *_ = shot.frames
    assert first.drawing == held.drawing != moved.drawing
    assert tuple(shot.cel(held).pixels[15, 20, :3]) == tuple(blob(RED)[15, 20, :3])
    assert tuple(shot.cel(moved).pixels[45, 40, :3]) == tuple(blob(GREEN)[15, 20, :3])


def test_what_cannot_be_drawn_is_told(tmp_path: Path) -> None:
    layers = (
        '<layer nodetype="shapelayer" name="title" filename="s"/>'
        '<layer nodetype="shapelayer" name="away" filename="s" visible="0"/>'
        + paint_layer("blurred", "l1", masks=mask("f", nodetype="filtermask"))
        + paint_layer("odd", "l1", compositeop="tangent_normalmap")
    )
    path = write_kra(tmp_path / "hero.kra", layers, {"l1": tiles(flat(RED))})
    with pytest.warns(LampblackWarning) as told:
        shot_of(path)
    texts = " ".join(str(warning.message) for warning in told)
    assert "'title' are vectors" in texts
    assert "away" not in texts
    assert "'blurred' have layer styles or masks" in texts
    assert "'odd' have blend modes" in texts


def test_other_colours_are_lit_as_one_picture_and_told(tmp_path: Path) -> None:
    layers = paint_layer("body", "l1", colorspacename="RGBA16")
    path = write_kra(tmp_path / "hero.kra", layers, {"l1": b""}, space="RGBA16")
    with pytest.warns(LampblackWarning, match="its layers are lit as one picture"):
        picture = painted(path)
    assert (picture == (10, 20, 30, 255)).all()


@pytest.mark.parametrize(
    "damaged",
    [b"", b"VERSION 2\n", tiles(flat(RED))[:-90], tiles(flat(RED)).replace(b"LZF", b"XYZ")],
)
def test_damaged_tiles_are_told(tmp_path: Path, damaged: bytes) -> None:
    path = write_kra(tmp_path / "hero.kra", paint_layer("body", "l1"), {"l1": damaged})
    with pytest.raises(ProjectError, match="damaged"):
        painted(path)


def test_any_flipped_byte_is_an_error_for_people_at_most(tmp_path: Path) -> None:
    whole, rng = tiles(canvas(blob(RED))), np.random.default_rng(4)
    for place in rng.integers(0, len(whole), 100):
        data = bytearray(whole)
        data[place] ^= 1 << rng.integers(8)
        path = write_kra(tmp_path / "hero.kra", paint_layer("body", "l1"), {"l1": bytes(data)})
        try:
            painted(path)
        except ProjectError:
            continue


@pytest.mark.parametrize(
    ("layers", "words"),
    [
        ("", "no layer with a picture"),
        (paint_layer("body", "none"), "has no hero/layers/none"),
        ("<layer/>" * 1001, "1000 layers"),
        (paint_layer("body", "l1", x="1e99"), "not possible"),
        ('<layer nodetype="grouplayer"><layers>' * 60 + "</layers></layer>" * 60, "deep"),
    ],
)
def test_descriptions_that_make_no_sense_are_told(tmp_path: Path, layers: str, words: str) -> None:
    path = write_kra(tmp_path / "hero.kra", layers, {"l1": tiles(flat(RED))})
    with pytest.raises(ProjectError, match=words):
        painted(path)


def test_the_size_is_checked_before_anything_is_read(tmp_path: Path) -> None:
    path = write_kra(tmp_path / "hero.kra", paint_layer("body", "l1"), {}, (90_000, 2))
    with pytest.raises(ProjectError, match="90000 x 2"):
        shot_of(path)
