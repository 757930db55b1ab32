"""``lampblack render`` from drawings to files, in earnest: lit, killed, interrupted."""

from __future__ import annotations

import os
import signal
import struct
import subprocess
import sys
import time
import zlib
from pathlib import Path

import numpy as np
import pytest

from lampblack.colour import linear
from lampblack.drawing import load_picture, save_picture
from support.command_line import Run, files
from support.drawings import draw_ball
from support.processes import gone
from support.projects import walk
from unit.test_drawing_load import chunk


def test_render_lights_a_sequence_and_holds_are_copies(run: Run, tmp_path: Path) -> None:
    drawings, lit = tmp_path / "in", tmp_path / "lit"
    drawings.mkdir()
    for number, fill in enumerate([(220, 120, 60), (60, 120, 220), (220, 120, 60)], start=1):
        save_picture(drawings / f"walk.{number:04d}.png", draw_ball(96, fill))
    sheet = tmp_path / "sheet.png"
    done = run("render", drawings, "-o", lit, "--light", "20,20,60", "--contact-sheet", sheet)
    assert done.code == 0, done.err
    assert files(lit) == {f"walk.{n:04d}.png" for n in (1, 2, 3)}
    first, second, third = (load_picture(lit / f"walk.{n:04d}.png") for n in (1, 2, 3))
    assert np.array_equal(first, third)
    assert not np.array_equal(first, second)
    assert np.abs(first.astype(int) - draw_ball(96)).max() > 20
    assert load_picture(sheet).shape[2] == 4


def linear_png(picture: np.ndarray) -> bytes:
    """``picture`` with 16 bits in linear light, as its gamma says."""
    height, width, _ = picture.shape
    light = np.dstack([linear(picture[..., :3] / 255.0), picture[..., 3:] / 255.0])
    rows = np.rint(light * 65535).astype(">u2").reshape(height, -1)
    data = zlib.compress(b"".join(b"\0" + row.tobytes() for row in rows))
    parts = (
        chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 16, 6, 0, 0, 0)),
        chunk(b"gAMA", struct.pack(">I", 100_000)),
        chunk(b"IDAT", data),
        chunk(b"IEND", b""),
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def test_a_drawing_in_linear_light_is_lit_as_it_looks(run: Run, tmp_path: Path) -> None:
    save_picture(tmp_path / "plain.png", draw_ball(96))
    (tmp_path / "linear.png").write_bytes(linear_png(draw_ball(96)))
    for name in ("plain", "linear"):
        done = run(
            "render", tmp_path / f"{name}.png", "-o", tmp_path / "lit", "--light", "20,20,60"
        )
        assert done.code == 0, done.err
    plain, light = (load_picture(tmp_path / "lit" / f"{n}.png") for n in ("plain", "linear"))
    assert np.array_equal(plain, light)


def test_a_job_that_is_killed_goes_on_where_it_was(tmp_path: Path) -> None:
    project, out = walk(tmp_path, [n % 20 for n in range(40)]), tmp_path / "lit"
    command = [sys.executable, "-m", "lampblack", "render", str(project), "-o", str(out)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, start_new_session=True)
    deadline = time.monotonic() + 120
    while len(list(out.glob("walk.*.png"))) < 3 and time.monotonic() < deadline:
        time.sleep(0.05)
    os.kill(process.pid, signal.SIGKILL)
    process.communicate()
    before = {path: path.stat().st_mtime_ns for path in out.glob("walk.*.png")}
    assert 3 <= len(before) < 40
    assert all(load_picture(path).shape == (96, 96, 4) for path in before)
    done = subprocess.run(command, capture_output=True, check=True, text=True)
    assert f"{len(before)} of them from before" in done.stderr
    assert {path: path.stat().st_mtime_ns for path in before} == before
    finished = [load_picture(out / f"walk.{n:04d}.png") for n in range(1, 41)]
    assert all(np.array_equal(finished[n], finished[n + 20]) for n in range(20))


def children_of(pid: int) -> list[int]:
    tasks = Path(f"/proc/{pid}/task").glob("*/children")
    return [int(child) for task in tasks for child in task.read_text().split()]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_interrupting_leaves_finished_frames_and_nothing_else(
    tmp_path: Path, number: signal.Signals
) -> None:
    drawings, out = tmp_path / "in", tmp_path / "lit"
    drawings.mkdir()
    for frame in range(1, 40):
        save_picture(drawings / f"a.{frame:04d}.png", draw_ball(96, (6 * frame, 40, 60)))
    command = [sys.executable, "-m", "lampblack", "render", drawings, "-o", out]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, start_new_session=True)
    deadline = time.monotonic() + 120
    while not list(out.glob("a.*.png")) and time.monotonic() < deadline:
        time.sleep(0.1)
    children = children_of(process.pid)
    assert children
    os.kill(process.pid, number)
    _, shown = process.communicate(timeout=60)
    assert process.returncode == 128 + number
    assert b"Traceback" not in shown
    if number == signal.SIGINT:
        assert b"Finished files are kept" in shown
    finished = files(out)
    assert 1 <= len(finished) < 39
    assert all(load_picture(out / name).shape == (96, 96, 4) for name in finished)
    assert gone(children, 3)
