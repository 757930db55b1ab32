"""``lampblack-window``, driven as an artist would."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from support.lamp import settled
from support.paths import BUILD
from support.window import Display, Program, wait_until

PROGRAM = BUILD / "lampblack-window"


class OwnWindow(Program):
    """A running window with a drawing, lit until it has converged."""

    canvas = "lampblack::CanvasView"

    def __init__(
        self,
        display: Display,
        folder: Path,
        drawing: Path,
        *,
        program: Path = PROGRAM,
        python: str = sys.executable,
    ) -> None:
        super().__init__(display, folder, [str(program), str(drawing)], python=python)
        self.take_window("Lampblack")
        self.wait_for(drawing)

    def wait_for(self, drawing: Path) -> None:
        wait_until(lambda: self.value("lampblack", "project") == str(drawing), "the drawing")
        wait_until(lambda: self.value("lampblack", "settled"), "a converged picture", 180)

    def screen(self, x: float, y: float) -> tuple[float, float]:
        """Of a canvas pixel."""
        left, top, _, _ = self.rect(self.canvas)
        a, b, c, d, e, f = self.value("lampblack.window.canvas", "imageToWidget")
        return left + a * x + c * y + e, top + b * x + d * y + f

    def crop(self, x: float, y: float, width: float, height: float) -> NDArray[np.uint8]:
        """A screenshot of a part of the canvas, in canvas pixels."""
        (left, top), (right, bottom) = self.screen(x, y), self.screen(x + width, y + height)
        left, top, right, bottom = map(round, (left, top, right, bottom))
        return self.display.screenshot(left, top, right - left, bottom - top)

    def drag_light(self, x: float, y: float) -> None:
        """To a canvas pixel; then wait for its light."""
        start, goal = self.screen(*self.value("lampblack", "lightPlaces")[0]), self.screen(x, y)
        path = [
            tuple(np.array(start) * (1 - t) + np.array(goal) * t) for t in np.linspace(0, 1, 25)
        ]
        for _ in self.drag(path):
            pass
        settled(self)
