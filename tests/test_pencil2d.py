"""The real Pencil2D, worker, network and Cycles, driven by mouse and keys in a virtual display.

Screenshots go to ``build/screenshots``. The example's camera shows 640 x 720 pixels, and its middle
is the middle of the canvas widget.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image
from registration import luminance, offset
from window import BUILD, ROOT, Display, Pencil2D, missing, pencil2d, wait_until

pytestmark = [
    pytest.mark.cycles,
    pytest.mark.timeout(600),
    pytest.mark.skipif(bool(missing()), reason=f"missing: {missing()}"),
]

SIZE = (640, 720)
SHOTS = BUILD.parent / "screenshots"
TOOL = "lampblack.tool"
LIT, NORMALS, RELIEF, FLAT = (f"lampblack.panel.view.{n}" for n in ("lit", "normals", "relief", "flat"))


@pytest.fixture(scope="module")
def display(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Display]:
    shown = Display(tmp_path_factory.mktemp("display"))
    yield shown
    shown.close()


def project_in(folder: Path) -> Path:
    """A fresh copy of the example, with one white light upper left, no floor, all diffuse."""
    project = folder / "walk.pclx"
    shutil.copy(ROOT / "examples" / "lamplighter.pclx", project)
    return project


def sidecar(project: Path) -> Path:
    return project.with_name(project.name + ".lampblack.json")


@pytest.fixture
def window(display: Display, tmp_path: Path) -> Iterator[Pencil2D]:
    with pencil2d(display, tmp_path, project_in(tmp_path)) as program:
        yield program


class Canvas:
    """The canvas on the screen, as it lies at ``zoom`` with nothing turned or moved."""

    def __init__(self, window: Pencil2D, zoom: float = 1.0) -> None:
        self._window, self.zoom = window, zoom
        left, top, width, height = window.rect("ScribbleArea")
        self.middle = (left + width / 2, top + height / 2)

    def screen(self, x: float, y: float) -> tuple[float, float]:
        """Of a canvas pixel."""
        return (
            self.middle[0] + (x - SIZE[0] / 2) * self.zoom,
            self.middle[1] + (y - SIZE[1] / 2) * self.zoom,
        )

    def crop(self, x: float, y: float, width: float, height: float) -> NDArray[np.uint8]:
        """A screenshot of a part of the canvas."""
        (left, top), (right, bottom) = self.screen(x, y), self.screen(x + width, y + height)
        picture = self._window.display.screenshot()
        return picture[round(top) : round(bottom), round(left) : round(right)]


def keep(window: Pencil2D, name: str) -> None:
    SHOTS.mkdir(parents=True, exist_ok=True)
    Image.fromarray(window.display.screenshot()).save(SHOTS / f"{name}.png")


def settled(window: Pencil2D) -> None:
    """Wait for the converged picture of the scene as it is now."""
    wait_until(lambda: window.value("lampblack", "settled"), "a converged picture", 120)


def light_up(window: Pencil2D) -> None:
    window.click("lampblackButton")
    settled(window)


def brightness_of_sides(canvas: Canvas) -> tuple[float, float]:
    """Mean luminance of the fur left and right of the belly, away from the handles."""
    left, right = canvas.crop(205, 470, 40, 60), canvas.crop(455, 400, 40, 60)
    return float(luminance(left).mean()), float(luminance(right).mean())


def light_on_screen(window: Pencil2D, canvas: Canvas) -> tuple[float, float]:
    x, y = window.value("lampblack", "lightPlaces")[0]
    return canvas.screen(x, y)


def drag_light(window: Pencil2D, canvas: Canvas, to: tuple[float, float]) -> None:
    x, y = light_on_screen(window, canvas)
    goal = canvas.screen(*to)
    path = [(x + (goal[0] - x) * t, y + (goal[1] - y) * t) for t in np.linspace(0, 1, 25)]
    for _ in window.drag(path):
        pass
    settled(window)


def assert_light_goes_right(window: Pencil2D, canvas: Canvas) -> None:
    drag_light(window, canvas, (40, 300))
    left_before, right_before = brightness_of_sides(canvas)
    drag_light(window, canvas, (600, 300))
    left_after, right_after = brightness_of_sides(canvas)
    assert right_after > right_before + 0.03
    assert left_after < left_before - 0.03


def test_near_side_brightens_and_far_side_darkens(window: Pencil2D) -> None:
    canvas = Canvas(window)
    light_up(window)
    keep(window, "lit")
    assert_light_goes_right(window, canvas)
    keep(window, "dragged")
    window.set("lampblack.panel.power.field", "value", 0.0)
    settled(window)
    with pytest.raises(AssertionError):
        assert_light_goes_right(window, canvas)


def worker_pids(window: Pencil2D) -> list[int]:
    """Workers that this Pencil2D started."""
    found = []
    for process in Path("/proc").iterdir():
        if not process.name.isdigit():
            continue
        try:
            parent = int((process / "stat").read_text().rsplit(")", 1)[1].split()[1])
            command = (process / "cmdline").read_bytes()
        except OSError:
            continue
        if parent == window.process.pid and b"lampblack\0serve" in command:
            found.append(int(process.name))
    return found


def test_worker_killed_while_dragging(window: Pencil2D) -> None:
    canvas = Canvas(window)
    light_up(window)
    before = window.value("lampblack", "shownRevision")
    (pid,) = worker_pids(window)
    start = light_on_screen(window, canvas)
    path = [(start[0] + 4 * i, start[1] + 2 * i) for i in range(60)]
    for index in window.drag(path, pause=0.03):
        if index == 20:
            os.kill(pid, signal.SIGKILL)
    settled(window)
    assert window.value("lampblack", "shownRevision") > before
    assert worker_pids(window) != [pid]
    assert window.process.poll() is None


def test_scene_is_saved_and_found_again(display: Display, tmp_path: Path) -> None:
    project = project_in(tmp_path)
    with pencil2d(display, tmp_path / "first", project) as window:
        canvas = Canvas(window)
        light_up(window)
        drag_light(window, canvas, (500, 100))
        assert not sidecar(project).exists()
        window.trigger("actionSave")
        wait_until(sidecar(project).exists, "the saved scene")
    (light,) = json.loads(sidecar(project).read_text())["lights"]
    assert (light["x"], light["y"]) == pytest.approx((500, 100), abs=2)
    with pencil2d(display, tmp_path / "second", project) as window:
        light_up(window)
        ((x, y),) = window.value("lampblack", "lightPlaces")
        assert (x, y) == pytest.approx((light["x"], light["y"]))
