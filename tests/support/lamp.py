"""The lamp tool in a real Pencil2D, on the example: what an artist does with it, and sees.

Screenshots go to ``build/screenshots``. The example's camera shows 640 x 720 pixels, and its middle
is the middle of the canvas widget.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from support.paths import BUILD, ROOT
from support.registration import luminance
from support.window import Pencil2D, Program, wait_until

SIZE = (640, 720)
SHOTS = BUILD.parent / "screenshots"


def project_in(folder: Path) -> Path:
    """A fresh copy of the example, with one white light upper left, no floor, all diffuse."""
    project = folder / "walk.pclx"
    shutil.copy(ROOT / "examples" / "lamplighter.pclx", project)
    return project


def sidecar(project: Path) -> Path:
    return project.with_name(project.name + ".lampblack.json")


class Canvas:
    """The canvas on the screen, as it lies at ``zoom`` with nothing turned or moved."""

    def __init__(self, window: Pencil2D, zoom: float = 1.0) -> None:
        self._window, self.zoom = window, zoom

    @property
    def middle(self) -> tuple[int, int]:
        """On the screen, as it is now: panels that open move it. Pencil2D draws pixels of a canvas
        that is an odd number wide half a pixel further right."""
        left, top, width, height = self._window.rect("ScribbleArea")
        return left + (width + 1) // 2, top + (height + 1) // 2

    def screen(self, x: float, y: float) -> tuple[float, float]:
        """Of a canvas pixel."""
        across, down = self.middle
        return across + (x - SIZE[0] / 2) * self.zoom, down + (y - SIZE[1] / 2) * self.zoom

    def crop(self, x: float, y: float, width: float, height: float) -> NDArray[np.uint8]:
        """A screenshot of a part of the canvas."""
        (left, top), (right, bottom) = self.screen(x, y), self.screen(x + width, y + height)
        left, top, right, bottom = map(round, (left, top, right, bottom))
        return self._window.display.screenshot(left, top, right - left, bottom - top)


def keep(window: Program, name: str) -> None:
    SHOTS.mkdir(parents=True, exist_ok=True)
    Image.fromarray(window.screenshot()).save(SHOTS / f"{name}.png")


def settled(window: Program) -> None:
    """Wait for the converged picture of the scene as it is now."""
    wait_until(lambda: window.value("lampblack", "settled"), "a converged picture", 120)


def shows_light(window: Pencil2D) -> bool:
    overlay = window.find("lampblack.overlay")["properties"]
    return bool(overlay["showsPicture"] or overlay["showsStandIn"])


def light_up(window: Pencil2D) -> None:
    window.click("lampblackButton")
    wait_until(lambda: window.value("lampblackButton", "checked"), "the lamp in use")
    # The button is down a moment before: until then the picture of the project before may count.
    wait_until(lambda: shows_light(window), "a shading")
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
