"""The canvas is never the plain drawing once it is lit, whatever the artist does.

The window's own pixels are looked at every 20 ms and after each paint, during the whole action.
Plain is a canvas where as many pixels as in the drawing have exactly the drawing's flat colours.
"""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from support.lamp import Canvas, keep, light_up, project_in, settled, shows_light
from support.registration import luminance
from support.window import Pencil2D, SharedPencil2D, wait_until

FUR = "#4f8fb3"
WHILE_PLAIN = 0.4
"""Of the flat pixels of a plain drawing: more of them mean that it is not lit."""


def plain_share(window: Pencil2D, colour: str = FUR) -> float:
    """The share of the canvas that has exactly the flat colour while the lamp is not in use."""
    window.watch([colour])

    def in_sight() -> float:
        looks = window.watch([colour])  # the first may be of what was shown before
        return float(looks[-1][1]) if looks and looks[-1][1] > 0.02 else 0.0

    share = wait_until(in_sight, "the plain figure")
    window.watch([])
    return float(share)


@contextmanager
def staying_lit(window: Pencil2D, plain: float, colour: str = FUR) -> Iterator[None]:
    """No look at the canvas finds it plain."""
    window.watch([colour])
    yield
    looks = window.watch([])
    assert looks
    flat = [
        (round(at), round(share / plain, 2)) for at, share in looks if share > WHILE_PLAIN * plain
    ]
    assert not flat, f"plain at (ms, share) {flat[:20]} of {len(looks)} looks"


def is_ready(window: Pencil2D) -> bool:
    return bool(window.value("lampblack.panel.worker", "text") == "Ready")


@pytest.fixture
def plain(window: Pencil2D) -> float:
    """The share of flat pixels in the plain drawing; then the canvas is lit."""
    share = plain_share(window)
    light_up(window)
    return share


@contextmanager
def busy_machine(processes: int = 4) -> Iterator[None]:
    """Others work on the machine meanwhile."""
    command = [sys.executable, "-c", "while True: pass"]
    others = [subprocess.Popen(command) for _ in range(processes)]
    try:
        yield
    finally:
        for other in others:
            other.kill()
            other.wait()


def play(window: Pencil2D, seconds: float) -> None:
    window.trigger("actionPlay")
    time.sleep(seconds)
    window.trigger("actionPlay")


def test_first_light_is_instant(window: Pencil2D) -> None:
    share = plain_share(window)
    window.watch([FUR])
    window.click("lampblackButton")
    wait_until(lambda: shows_light(window), "an instant shading")
    assert not is_ready(window) or window.value("lampblack.overlay", "showsPicture")
    settled(window)
    looks = window.watch([])
    lit = [at for at, seen in looks if seen < WHILE_PLAIN * share]
    assert lit, "it is lit at last"
    assert all(seen < WHILE_PLAIN * share for at, seen in looks if at >= lit[0])


def test_selecting_and_deselecting(window: Pencil2D, plain: float) -> None:
    with staying_lit(window, plain):
        window.trigger("actionSelect_All")
        window.trigger("actionDeselect_All")
        with suppress(AssertionError):  # a fast machine reads it again between two looks
            wait_until(lambda: not is_ready(window), "the drawing to be read again", 5)
        wait_until(lambda: is_ready(window), "the light", 30)
        settled(window)
    keep(window, "deselected")


def name_the_file(window: Pencil2D, path: Path) -> None:
    """Answer the dialog that asks where to save."""
    dialog = wait_until(lambda: window.of_class("QFileDialog"), "the file dialog")
    assert dialog["seen"]

    def saved() -> bool:
        """Keys may come before it has the focus, and it goes before the file is there."""
        if window.of_class("QFileDialog"):
            with suppress(AssertionError):  # it went in this moment
                window.set("fileNameEdit", "text", str(path))
                window.key("Return")
        return path.exists()

    wait_until(saved, "the file")
    wait_until(lambda: not window.of_class("QFileDialog"), "the end of the dialog")


def test_saving_under_another_name(window: Pencil2D, plain: float, tmp_path: Path) -> None:
    with staying_lit(window, plain):
        window.trigger("actionSave_as")
        name_the_file(window, tmp_path / "other.pclx")
        wait_until(lambda: is_ready(window), "the light", 30)
        settled(window)
    keep(window, "saved as")


def paint_a_disc(window: Pencil2D) -> str:
    """A line around the middle of the canvas, and colour in it; the colour."""
    left, top, width, height = window.rect("ScribbleArea")
    x, y = left + width / 2, top + height / 2
    turns = np.linspace(0, 2.4 * np.pi, 50)
    window.click("pencilButton")
    for _ in window.drag([(x + 130 * np.cos(turn), y + 110 * np.sin(turn)) for turn in turns]):
        pass
    window.click("bucketButton")
    window.set("colorSpecTabWidget", "currentIndex", 1)
    window.set("redSpinBox", "value", 255)
    window.click_at(x, y)
    window.set("colorSpecTabWidget", "currentIndex", 0)
    return "#ff0000"


def test_a_new_project_and_its_first_save(
    window: Pencil2D, plain: float, shared: SharedPencil2D, tmp_path: Path
) -> None:
    with staying_lit(window, plain):
        window.trigger("actionNew")
        wait_until(lambda: window.value("lampblack", "project") == "", "the new project")
        wait_until(lambda: not shows_light(window), "an empty canvas")
    red = paint_a_disc(window)
    share = plain_share(window, red)
    light_up(window)
    with staying_lit(window, share, red):
        window.trigger("actionSave")
        name_the_file(window, tmp_path / "mine.pclx")
        wait_until(lambda: is_ready(window), "the light", 30)
        settled(window)
        keep(window, "first save")
    shared.close()  # Pencil2D calls a project modified that is opened after a new one


def test_going_to_frames_never_seen(window: Pencil2D, plain: float) -> None:
    with busy_machine(), staying_lit(window, plain):
        for _ in range(6):
            window.trigger("actionNext_Frame")
            assert not is_ready(window) or window.value("lampblack", "settled")
            time.sleep(0.2)
        keep(window, "frame never seen")
        for _ in range(3):
            window.trigger("actionPrevious_Frame")
    settled(window)
    keep(window, "frame seen")


def test_playing_frames_never_seen(window: Pencil2D, plain: float) -> None:
    with staying_lit(window, plain):
        play(window, 3)
        settled(window)


def test_playing_while_surfaces_are_made_and_after(window: Pencil2D, plain: float) -> None:
    window.trigger("lampblack.panel.generate")
    with staying_lit(window, plain):
        with busy_machine():
            play(window, 3)
        bar = "lampblack.panel.progress"
        wait_until(lambda: not window.value(bar, "visible"), "all surfaces", 240)
        with busy_machine():
            play(window, 3)
        settled(window)


def test_undoing_a_stroke(window: Pencil2D, plain: float) -> None:
    window.click("pencilButton")
    canvas = Canvas(window)
    for _ in window.drag([canvas.screen(100 + 4 * i, 680) for i in range(30)]):
        pass
    light_up(window)
    settled(window)
    drawn = canvas.crop(100, 670, 120, 20)
    with staying_lit(window, plain):
        window.trigger("actionUndo")
        wait_until(lambda: (canvas.crop(100, 670, 120, 20) != drawn).any(), "the stroke to go")
        settled(window)


def test_moving_the_view(window: Pencil2D, plain: float) -> None:
    with staying_lit(window, plain):
        for action in ("actionZoom_In", "actionZoom_In", "actionZoom_Out", "actionZoom_Out"):
            window.trigger(action)
            time.sleep(0.2)
        window.trigger("actionZoom_Out")
        settled(window)


def test_another_project_is_never_ready_while_it_is_plain(
    window: Pencil2D, plain: float, tmp_path: Path
) -> None:
    folder = tmp_path / "another"
    folder.mkdir()
    another = project_in(folder)
    window.display.do("windowactivate", "--sync", window.window)
    window.ask_to_open(another)
    wait_until(lambda: window.value("lampblack", "project") == str(another), "the project")
    wait_until(lambda: shows_light(window), "a shading", 10)
    with staying_lit(window, plain):
        settled(window)


def draw_lines(window: Pencil2D, canvas: Canvas, count: int) -> dict[str, Any]:
    """Strokes on the figure; what the event loop's turns took meanwhile."""
    window.stalls()
    for line in range(count):
        y = 470 + 8 * line
        for _ in window.drag([canvas.screen(250 + 5 * i, y) for i in range(30)]):
            pass
    return window.stalls()


def test_drawing_keeps_the_light(window: Pencil2D, plain: float) -> None:
    window.set("lampblack.keep_light", "checked", True)
    canvas = Canvas(window)
    try:
        with staying_lit(window, plain):
            window.click("pencilButton")
            time.sleep(1)
            keep(window, "drawing")
            draw_lines(window, canvas, 3)
            keep(window, "drawn")
            time.sleep(3)
            window.click("eraserButton")
            draw_lines(window, canvas, 1)
            time.sleep(2)
            settled(window)
        keep(window, "drawn and lit")
        settled_ink = canvas.crop(300, 468, 60, 20)
        assert luminance(settled_ink).min() < 0.5, "the strokes are there"
    finally:
        window.set("lampblack.keep_light", "checked", False)
