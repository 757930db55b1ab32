"""``lampblack layers``: what a program that cannot read a drawing is told of it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from psd_tools.constants import BlendMode

from lampblack.drawing import load_picture, save_picture
from lampblack.errors import OutputError
from lampblack.finals import layer_files
from lampblack.finals.layer_files import open_layers, write_layers
from lampblack.project import read_project
from lampblack.project.shot import ProjectShot
from support.command_line import Run, files
from support.drawings import draw_ball
from support.layered import apart, blob
from support.paths import ROOT
from support.projects import document, image, layer, png, write_project
from unit import test_psd as photoshop
from unit.test_ora import write_ora

Record = dict[str, Any]


def together(folder: Path, record: Record, size: tuple[int, int]) -> NDArray[np.uint8]:
    """The files of a frame, painted over each other."""
    canvas = Image.new("RGBA", size)
    for name in record["files"].values():
        canvas.alpha_composite(Image.fromarray(load_picture(folder / name)))
    return np.asarray(canvas)


def test_a_missing_frame_of_a_sequence_shows_the_one_before(tmp_path: Path, run: Run) -> None:
    drawings, out = tmp_path / "walk", tmp_path / "out"
    drawings.mkdir()
    for number in (3, 5):
        save_picture(drawings / f"walk.{number:04d}.png", draw_ball(64, (40 * number, 40, 60)))
    shown = run("layers", drawings, "-o", out, "--first", 5)
    assert shown.code == 0
    shot, *frames = map(json.loads, shown.out.splitlines())
    assert (shot["canvas"], shot["first"], shot["last"]) == ([64, 64], 3, 5)
    assert shot["layers"] == [{"name": "Drawing", "visible": True}]
    assert [frame["frame"] for frame in frames] == [5, 3, 4]
    five, three, four = (frame["files"]["Drawing"] for frame in frames)
    assert three == four != five
    assert np.array_equal(load_picture(out / five), draw_ball(64, (200, 40, 60)))
    assert files(out) == {three, five}


def test_layers_of_a_project_are_what_its_camera_shows(tmp_path: Path) -> None:
    example = ROOT / "examples" / "lamplighter.pclx"
    shot, *frames = write_layers(open_layers(str(example)), tmp_path)
    whole = ProjectShot(*read_project(example), {})
    assert [one["name"] for one in shot["layers"]] == [
        each.name for each in read_project(example)[0].layers
    ]
    assert len(frames) == len(whole.frames)
    for record, frame in list(zip(frames, whole.frames, strict=True))[::4]:
        expected = whole.finish(frame, whole.cel(frame).pixels)
        assert np.array_equal(together(tmp_path, record, shot["canvas"]), expected)


def test_a_moved_camera_is_told_and_seen_through(tmp_path: Path) -> None:
    camera = '<camera frame="1" r="0" s="1" dx="20" dy="-10"/>'
    xml = document([layer(2, "Ball", [image(1, "a.png", -32, -32)])], camera=camera)
    project = write_project(
        tmp_path / "ball.pclx", xml, {"a.png": png(draw_ball(64, (200, 40, 60)))}
    )
    _, frame = write_layers(open_layers(str(project)), tmp_path)
    assert frame["view"] == (1, 0, 20, 0, 1, -10)
    seen = load_picture(tmp_path / frame["files"]["Ball"])
    rows, columns = np.nonzero(seen[..., 3])
    assert abs(columns.mean() + 0.5 - (100 + 20)) < 1
    assert abs(rows.mean() + 0.5 - (80 - 10)) < 1


def test_layers_that_touch_up_what_is_below_are_shown_exactly(tmp_path: Path) -> None:
    stack = (
        '<layer name="shade" src="data/b.png" x="6" y="6" composite-op="svg:multiply"/>'
        '<layer name="line" src="data/r.png" x="4" y="5"/>'
        '<layer name="line" src="data/g.png" x="0" y="0"/>'
        '<layer name="notes" src="data/g.png" visibility="hidden"/>'
    )
    drawing = write_ora(tmp_path, stack)
    shot, frame = write_layers(open_layers(str(drawing)), tmp_path)
    assert [one["name"] for one in shot["layers"]] == ["line", "line (2)"]
    exact = ProjectShot(*read_project(drawing), {})
    expected = exact.cel(exact.frames[0]).pixels
    assert np.array_equal(load_picture(tmp_path / frame["whole"]), expected)


def test_pictures_are_kept_while_they_are_shown(tmp_path: Path) -> None:
    out = tmp_path / "out"
    out.mkdir()
    stack = '<layer name="line" src="data/r.png" x="4"/><layer name="fill" src="data/{}.png"/>'
    drawing = write_ora(tmp_path, stack.format("g"))
    before = list(write_layers(open_layers(str(drawing)), out))[-1]["files"]
    written = (out / before["line"]).stat().st_mtime_ns
    write_ora(tmp_path, stack.format("b"))
    after = list(write_layers(open_layers(str(drawing)), out))[-1]["files"]
    assert after["line"] == before["line"]
    assert (out / after["line"]).stat().st_mtime_ns == written
    assert files(out) == {after["line"], after["fill"]}
    assert after["fill"] != before["fill"]


def test_a_frame_that_cannot_be_read_does_not_stop_the_others(tmp_path: Path, run: Run) -> None:
    for number in (1, 2):
        save_picture(tmp_path / f"{number}.png", draw_ball(64, (40 * number, 40, 60)))
    (tmp_path / "2.png").write_bytes((tmp_path / "2.png").read_bytes()[:200])
    shown = run("layers", tmp_path, "-o", tmp_path / "out")
    assert shown.code == 0
    _, one, two = map(json.loads, shown.out.splitlines())
    assert one["files"]
    assert "2.png" in two["error"]["what"]
    missing = run("layers", tmp_path / "no.ora", "-o", tmp_path / "out")
    assert missing.code == 1
    assert json.loads(missing.out)["error"]["remedy"]


def test_the_folder_does_not_grow_without_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawing = tmp_path / "ball.png"
    save_picture(drawing, draw_ball(64, (200, 40, 60)))
    monkeypatch.setattr(layer_files, "MAX_BYTES", 10)
    with pytest.raises(OutputError, match="GiB"):
        list(write_layers(open_layers(str(drawing)), tmp_path))


def test_a_photoshop_file_is_shown_as_photoshop_shows_it(tmp_path: Path) -> None:
    psd = photoshop.new()
    photoshop.put(psd, "body", blob((200, 40, 60), soft=0), (10, 10))
    shade = blob((40, 60, 200))
    photoshop.put(psd, "shade", shade, (25, 20), blend_mode=BlendMode.MULTIPLY).clipping = True
    photoshop.put(psd, "arm", blob((40, 180, 60), (30, 12)), (40, 22))
    drawing = photoshop.saved(tmp_path, psd)
    shot, frame = write_layers(open_layers(str(drawing)), tmp_path)
    assert [one["name"] for one in shot["layers"]] == ["body", "arm"]
    expected = photoshop.their_composite(drawing)
    assert apart(load_picture(tmp_path / frame["whole"]), expected).max() <= 2
    # What is clipped goes with its base, so the layers alone are right too.
    assert apart(together(tmp_path, frame, shot["canvas"]), expected).max() <= 3
