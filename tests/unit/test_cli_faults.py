"""Bad input, full disks and interruptions: sentences, exit codes, and nothing lost."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lampblack.drawing import load_picture, save_picture
from lampblack.scene import MAX_LIGHTS, default_scene, encode_scene
from support.command_line import Run, files
from support.drawings import draw_ball


def blank(path: Path) -> None:
    save_picture(path, np.zeros((50, 40, 4), np.uint8))


def one_pixel(path: Path) -> None:
    save_picture(path, np.full((1, 1, 4), 255, np.uint8))


def one_wide(path: Path) -> None:
    save_picture(path, np.full((100, 1, 4), (0, 0, 0, 255), np.uint8))


def enormous(path: Path) -> None:
    Image.new("1", (8000, 8000)).save(path)


def truncated(path: Path) -> None:
    save_picture(path, draw_ball())
    path.write_bytes(path.read_bytes()[:-400])


def text(path: Path) -> None:
    path.write_text("not a picture")


def empty(path: Path) -> None:
    path.write_bytes(b"")


@pytest.mark.parametrize(
    "make", [blank, one_pixel, one_wide, enormous, truncated, text, empty], ids=lambda m: m.__name__
)
def test_bad_drawings_are_told_and_the_others_finished(
    run: Run, tmp_path: Path, unrendered: list[str], make: Callable[[Path], None]
) -> None:
    folder, out = tmp_path / "in", tmp_path / "lit"
    folder.mkdir()
    make(folder / "a.0002.png")
    alone = run("render", folder, "-o", out)
    assert alone.code == 1
    assert "error:" in alone.err
    assert files(out) == set()

    for number in (1, 3):
        save_picture(folder / f"a.{number:04d}.png", draw_ball(64, (60 * number, 40, 60)))
    among = run("render", folder, "-o", out)
    assert among.code in (1, 3)
    assert "a.0002.png" in among.err
    assert {"a.0001.png", "a.0003.png"} <= files(out) <= {f"a.000{n}.png" for n in (1, 2, 3)}
    for command in ("normals", "mesh"):
        suffix = ".npy" if command == "normals" else ".glb"
        assert run(command, folder / "a.0002.png", "-o", tmp_path / f"x{suffix}").code == 1
        assert not (tmp_path / f"x{suffix}").exists()


def test_blank_frames_of_a_sequence_pass_through_unlit(
    run: Run, tmp_path: Path, unrendered: list[str]
) -> None:
    folder, out = tmp_path / "in", tmp_path / "lit"
    folder.mkdir()
    blank(folder / "a.0001.png")
    save_picture(folder / "a.0002.png", draw_ball(64))
    done = run("render", folder, "-o", out)
    assert done.code == 3
    assert "unlit" in done.err
    assert (load_picture(out / "a.0001.png") == 0).all()
    assert run("scene", folder, "-o", tmp_path / "scene.json").code == 0
    assert run("palette", folder).code == 0


def test_frames_of_other_sizes_are_lit_with_a_warning(
    run: Run, tmp_path: Path, unrendered: list[str]
) -> None:
    for number, size in ((1, 64), (2, 96)):
        save_picture(tmp_path / f"a.{number}.png", draw_ball(size))
    done = run("render", tmp_path, "-o", tmp_path / "lit")
    assert done.code == 0
    assert "96 x 96" in done.err
    assert load_picture(tmp_path / "lit" / "a.2.png").shape == (96, 96, 4)


@pytest.mark.parametrize(
    "content",
    [
        b"{",
        b'{"version": 99, "canvas": {"width": 9, "height": 9}}',
        b'{"canvas": {"width": 9, "height": 9}, "relief_scale": NaN}',
        b'{"canvas": {"width": 9, "height": 9}, "floor": {"y": 1e30}}',
    ],
)
def test_bad_scenes_are_told(
    run: Run, tmp_path: Path, ball_png: Path, unrendered: list[str], content: bytes
) -> None:
    scene = tmp_path / "scene.json"
    scene.write_bytes(content)
    done = run("render", ball_png, "-o", tmp_path / "lit", "--scene", scene)
    assert done.code == 1
    assert "scene" in done.err
    assert not unrendered
    assert run("render", ball_png, "-o", tmp_path / "lit", "--scene", tmp_path / "no").code == 1


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"[]",
        b'{"hints": [{"frame": -1}]}',
        b'{"hints": [{"frame": 1, "front": "top"}]}',
        b'{"hints": [{"frame": 1, "points": [{"x": 1e300, "y": 0}]}]}',
        b'{"hints": [' + b'{"frame": 1},' * 128 + b'{"frame": 1}]}',
        b'{"layers": [{"layer": "arm", "body": "round"}]}',
    ],
)
def test_bad_depth_hints_are_told(
    run: Run, tmp_path: Path, ball_png: Path, unrendered: list[str], content: bytes
) -> None:
    hints = tmp_path / "hints.json"
    hints.write_bytes(content)
    done = run("render", ball_png, "-o", tmp_path / "lit", "--depth-hints", hints)
    assert done.code == 1
    assert "hints" in done.err
    assert not unrendered
    missing = tmp_path / "no.json"
    assert run("height", ball_png, "-o", tmp_path / "h.npy", "--depth-hints", missing).code == 1
    assert not (tmp_path / "h.npy").exists()


@pytest.mark.parametrize("line", ["nan", "1e30", "inf"])
def test_bad_floors_are_told(
    run: Run, tmp_path: Path, ball_png: Path, unrendered: list[str], line: str
) -> None:
    done = run("render", ball_png, "-o", tmp_path / "lit", "--floor", line)
    assert done.code == 1
    assert "floor" in done.err
    assert not unrendered


@pytest.mark.parametrize("light", ["1,2", "a,b,c", "nan,1,2", "1,2,1e30", ""])
def test_bad_lights_are_told(
    run: Run, tmp_path: Path, ball_png: Path, unrendered: list[str], light: str
) -> None:
    assert run("render", ball_png, "-o", tmp_path / "lit", "--light", light).code == 1
    assert not unrendered


def test_output_that_would_lose_something_is_refused(
    run: Run, tmp_path: Path, ball_png: Path, unrendered: list[str]
) -> None:
    before = ball_png.read_bytes()
    assert run("render", ball_png, "-o", ball_png.parent).code == 1
    (tmp_path / "in-the-way").write_text("")
    assert run("render", ball_png, "-o", tmp_path / "in-the-way").code == 1
    other = tmp_path / "other"
    other.mkdir()
    save_picture(other / "ball.png", draw_ball(64))
    assert run("render", ball_png, other, "-o", tmp_path / "lit").code == 1
    assert run("mesh", ball_png, "-o", tmp_path / "ball.fbx").code == 1
    assert run("normals", ball_png, "-o", tmp_path / "in-the-way" / "n.npy").code == 1
    assert run("normals", ball_png, "-o", ball_png).code == 1
    lit = ("-o", tmp_path / "lit")
    assert run("render", ball_png, *lit, "--contact-sheet", ball_png).code == 1
    assert run("render", ball_png, *lit, "--contact-sheet", tmp_path / "sheet.jpg").code == 1
    assert ball_png.read_bytes() == before
    assert not unrendered


@pytest.fixture
def full_disk(tmp_path: Path) -> Iterator[Path]:
    """A file system with room for next to nothing."""
    folder = tmp_path / "tiny"
    folder.mkdir()
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=32k", "tmpfs", folder], capture_output=True
    )
    if mounted.returncode:
        pytest.skip("mounting a small disk needs root")
    yield folder
    subprocess.run(["umount", "-l", folder], check=True)


def test_a_full_disk_keeps_what_is_finished(
    run: Run, tmp_path: Path, unrendered: list[str], full_disk: Path
) -> None:
    drawings = tmp_path / "in"
    drawings.mkdir()
    save_picture(drawings / "a.1.png", draw_ball(64))
    noise = np.random.default_rng(0).integers(0, 255, (200, 200, 4), dtype=np.uint8)
    noise[..., 3] = draw_ball(200)[..., 3]
    save_picture(drawings / "a.2.png", noise)
    done = run("render", drawings, "-o", full_disk)
    assert done.code == 1
    assert "Failed: a.2.png" in done.err
    assert "could not be written" in done.err
    assert files(full_disk) == {"a.1.png"}
    assert np.array_equal(load_picture(full_disk / "a.1.png"), draw_ball(64))


def test_lights_past_the_last_are_refused(
    run: Run, tmp_path: Path, ball_png: Path, unrendered: list[str]
) -> None:
    many = [part for _ in range(MAX_LIGHTS + 1) for part in ("--light", "1,2,3")]
    assert run("render", ball_png, "-o", tmp_path / "lit", *many).code == 1
    scene = tmp_path / "scene.json"
    scene.write_bytes(encode_scene(default_scene(160, 160)))
    assert run("render", ball_png, "-o", tmp_path / "lit", "--scene", scene).code == 0


def test_names_are_told_as_they_are(run: Run, tmp_path: Path) -> None:
    (tmp_path / "bad [red] [x].png").write_text("")
    assert "bad [red] [x].png" in run("render", tmp_path, "-o", tmp_path / "lit").err


def test_names_do_not_steer_the_terminal(run: Run, tmp_path: Path) -> None:
    for name in (b"a\x1b[2J\x1b]0;t\x07.png", b"b\r\x9b.png", b"c\xff\xfe.png"):
        (tmp_path / os.fsdecode(name)).write_text("")
    told = run("render", tmp_path, "-o", tmp_path / "lit").err
    assert "a\\x1b[2J" in told
    assert "b\\x0d" in told
    assert "c\\udcff\\udcfe.png" in told
    assert not any(control in told for control in ("\x1b[2J", "\x07", "\r", "\x9b"))
