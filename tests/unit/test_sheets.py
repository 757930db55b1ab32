"""Sprite sheets cut and joined, and normal maps as game engines read them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lampblack.drawing import load_picture, save_picture
from lampblack.errors import LampblackError
from lampblack.finals.normal_map import engine_of, normal_map
from lampblack.finals.sheet import SheetShot, cells_of, save_sheet
from support.command_line import Run, files
from support.drawings import draw_ball

BALLS = [draw_ball(48, colour) for colour in ((200, 60, 40), (40, 170, 60), (50, 80, 210))]


@pytest.fixture
def sheet(tmp_path: Path) -> Path:
    """3 x 2 cells: three balls, and an empty cell, and two of the balls again."""
    rows = [[0, 1, 2], [None, 1, 0]]
    nothing = np.zeros((48, 48, 4), np.uint8)
    cells = [[nothing if n is None else BALLS[n] for n in row] for row in rows]
    save_picture(tmp_path / "hero.png", np.vstack([np.hstack(row) for row in cells]))
    return tmp_path / "hero.png"


def test_cells_are_frames_row_by_row(sheet: Path) -> None:
    shot = SheetShot(sheet, (3, 2))
    assert [frame.name for frame in shot.frames][:2] == ["hero.0001.png", "hero.0002.png"]
    assert [frame.blank for frame in shot.frames] == [False, False, False, True, False, False]
    assert np.array_equal(shot.cel(shot.frames[2]).pixels, BALLS[2])
    drawings = [frame.drawing for frame in shot.frames]
    assert drawings[0] == drawings[5]
    assert drawings[1] == drawings[4]
    assert len(set(drawings)) == 4


def test_a_sheet_is_lit_cell_by_cell_and_joined_again(
    run: Run, tmp_path: Path, sheet: Path, unrendered: list[str]
) -> None:
    out, joined = tmp_path / "lit", tmp_path / "lit.png"
    done = run("render", sheet, "--sheet", "3x2", "-o", out, "--sprite-sheet", joined)
    assert done.code == 0, done.err
    assert files(out) == {f"hero.{n:04d}.png" for n in range(1, 7)}
    assert len(unrendered) == 3
    found = load_picture(joined)
    assert found.shape == load_picture(sheet).shape
    assert np.array_equal(found[..., 3], load_picture(sheet)[..., 3])
    assert np.array_equal(found[48:, 96:], load_picture(out / "hero.0006.png"))


def test_normals_of_a_sheet_for_an_engine(run: Run, tmp_path: Path, sheet: Path) -> None:
    joined = tmp_path / "hero_n.png"
    words = ("--sheet", "3x2", "--grids", 1, "--sprite-sheet", joined)
    told = run("normals", sheet, "-o", tmp_path / "n", "--engine", "unreal", *words)
    assert told.code == 0, told.err
    assert "hero.0001_N.png" in files(tmp_path / "n")
    down = load_picture(joined)
    assert down.shape == (96, 144, 4)
    assert run("normals", sheet, "-o", tmp_path / "up", "--engine", "godot", *words).code == 0
    assert "hero.0001_n.png" in files(tmp_path / "up")
    up = load_picture(joined)
    inside = (up[..., 3] > 0) & (down[..., 3] > 0)
    assert np.abs(up[inside, 1].astype(int) + down[inside, 1] - 255).max() <= 1
    assert np.array_equal(up[inside, 0], down[inside, 0])
    assert up[8, 24, 1] > 140, "the top of a ball faces up"


def test_normals_are_flat_around_the_character_for_engines_only() -> None:
    normals = np.zeros((2, 2, 3), np.float32)
    normals[0, 0] = 0.6, 0.8, 0
    mask = np.array([[True, False], [False, False]])
    plain = normal_map(normals, mask, "up", flat=engine_of(None).flat)
    assert plain[0, 0].tolist() == [204, 230, 128, 255]
    assert plain[1, 1].tolist() == [0, 0, 0, 0]
    assert normal_map(normals, mask, "down", flat=True)[0, 0].tolist() == [204, 25, 128, 255]
    assert normal_map(normals, mask, "up", flat=True)[1, 1].tolist() == [128, 128, 255, 0]


@pytest.mark.parametrize(("text", "cells"), [("8x4", (8, 4)), ("1X12", (1, 12)), (" 2×3 ", (2, 3))])
def test_cells_are_columns_and_rows(text: str, cells: tuple[int, int]) -> None:
    assert cells_of(text) == cells


@pytest.mark.parametrize("text", ["", "8", "0x4", "8x", "8x4x2", "-1x2", "9999x9999"])
def test_other_cells_are_refused(text: str) -> None:
    with pytest.raises(LampblackError, match="cells"):
        cells_of(text)


def test_what_cannot_be_cut_or_joined_is_told(
    run: Run, tmp_path: Path, sheet: Path, unrendered: list[str]
) -> None:
    out = ("-o", tmp_path / "lit")
    assert (
        "144 x 96 pixels, which cannot be cut" in run("render", sheet, "--sheet", "5x2", *out).err
    )
    save_picture(tmp_path / "other.png", BALLS[0])
    both = (sheet, tmp_path / "other.png")
    assert "--sheet cuts one" in run("render", *both, "--sheet", "3x2", *out).err
    lost = run("render", sheet, "--sheet", "3x2", *out, "--sprite-sheet", sheet)
    assert "is one of the inputs" in lost.err
    assert (
        "PNG frames only"
        in run(
            "render", sheet, "--sheet", "3x2", *out, "--format", "exr", "--sprite-sheet", "a.png"
        ).err
    )
    assert not unrendered
    with pytest.raises(LampblackError, match="too large"):
        save_sheet(tmp_path / "s.png", [np.zeros((9000, 9000, 4), np.uint8)] * 4)


def test_a_sheet_without_cells_is_about_square(tmp_path: Path) -> None:
    wide = np.full((10, 40, 4), 9, np.uint8)
    save_sheet(tmp_path / "s.png", [wide, None, wide, wide])
    found = load_picture(tmp_path / "s.png")
    assert found.shape == (40, 40, 4)
    assert not found[10:20].any()
