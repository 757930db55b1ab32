"""What is in front, in the real Pencil2D: a puppet of two layers, drawn and corrected by hand."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from support.lamp import keep, light_up, settled, sidecar
from support.projects import document, image, layer, png, write_project
from support.registration import luminance
from support.window import Pencil2D, SharedPencil2D, wait_until

SIZE = (640, 480)
COAT, SKIN = 0, 1
"""Rows of the palette."""
LIT, DEPTH = (f"lampblack.panel.view.{name}" for name in ("lit", "depth"))
MENU = "lampblack.cut_menu"
BODY = [(320.0, 170.0 + 2 * i) for i in range(70)]
ARM = [(270.0 + 2 * i, 240.0 + i / 3) for i in range(90)]
CUT = [(290.0 + 2 * i, 205.0) for i in range(40)]
"""Strokes, pixels of the canvas."""


def project_in(folder: Path) -> Path:
    """A project with an empty layer, and two colours."""
    colours = {"Coat": (70, 110, 190), "Skin": (214, 140, 90)}
    palette = "".join(
        f'<Colour red="{r}" green="{g}" blue="{b}" alpha="255" name="{name}"/>'
        for name, (r, g, b) in colours.items()
    )
    xml = document([layer(2, "Body", [image(1, "002.001.png")])], size=SIZE)
    files = {
        "002.001.png": png(np.zeros((1, 1, 4), np.uint8)),
        "palette.xml": f"<!DOCTYPE PencilPalette><palette>{palette}</palette>".encode(),
    }
    return write_project(folder / "puppet.pclx", xml, files)


class Hand:
    """Draws on the canvas, which lies as it was opened."""

    def __init__(self, window: Pencil2D) -> None:
        self._window = window

    def screen(self, x: float, y: float) -> tuple[float, float]:
        left, top, width, height = self._window.rect("ScribbleArea")
        return left + width / 2 + x - SIZE[0] / 2, top + height / 2 + y - SIZE[1] / 2

    def stroke(self, path: list[tuple[float, float]]) -> None:
        for _ in self._window.drag([self.screen(*at) for at in path], pause=0.02):
            pass

    def paint(self, colour: int, width: float, path: list[tuple[float, float]]) -> None:
        """A thick line with Pencil2D's pen."""
        self._window.click("penButton")
        left, top, *_ = self._window.rect("colorListWidget")
        self._window.click_at(left + 80, top + 18 + 36 * colour)
        self._window.set("brushSpinBox", "value", width)
        self.stroke(path)

    def click(self, x: float, y: float, button: int = 1) -> None:
        self._window.click_at(*self.screen(x, y), button)

    def is_skin(self, x: float, y: float) -> bool:
        left, top = map(round, self.screen(x, y))
        red, _, blue = self._window.display.screenshot(left, top, 1, 1)[0, 0].astype(int)
        return bool(red > blue + 30)

    def look(self, x: float, y: float, width: float, height: float) -> Any:
        """(H, W) luminance of a part of the canvas."""
        left, top = map(round, self.screen(x, y))
        return luminance(self._window.display.screenshot(left, top, round(width), round(height)))


def draw_puppet(window: Pencil2D, hand: Hand) -> None:
    hand.paint(COAT, 180.0, BODY)
    window.key("ctrl+alt+b")
    wait_until(lambda: window.of_class("QInputDialog"), "the name of the new layer")
    focus = "getwindowfocus", "getwindowname"
    wait_until(lambda: "Layer" in window.display.do(*focus), "its keyboard focus")
    window.display.do("type", "Arm")
    window.key("Return")
    wait_until(lambda: not window.of_class("QInputDialog"), "the new layer")
    hand.paint(SKIN, 50.0, ARM)


def light_puppet(window: Pencil2D, hand: Hand) -> None:
    light_up(window)

    def lit_with_the_arm() -> bool:
        shown = window.value("lampblack.overlay", "showsPicture")
        return bool(shown and window.value("lampblack", "settled") and hand.is_skin(350, 253))

    # The stroke may be noticed only after the lamp was picked.
    wait_until(lit_with_the_arm, "the arm in the lit picture", 120)


def choose(window: Pencil2D, hand: Hand, entry: str) -> None:
    """From the menu of the cut."""
    hand.click(330, 205, button=3)
    wait_until(lambda: window.find(MENU).get("seen"), "the menu")
    keep(window, "puppet menu")
    left, top, width, height = window.entries(MENU)[entry]
    window.click_at(left + width / 2, top + height / 2)
    wait_until(lambda: not window.find(MENU).get("seen"), "the menu to close")


def cuts(window: Pencil2D) -> list[Any]:
    return list(window.value("lampblack", "cutPlaces") or ())


def hints_in(project: Path) -> list[Any]:
    return list(json.loads(sidecar(project).read_text())["depth"]["hints"])


@pytest.fixture
def project(tmp_path: Path) -> Path:
    return project_in(tmp_path)


def test_a_click_brings_the_other_side_in_front(shared: SharedPencil2D, project: Path) -> None:
    window = shared.open(project)
    hand = Hand(window)
    draw_puppet(window, hand)
    light_puppet(window, hand)
    keep(window, "puppet lit")
    before = hand.look(250, 180, 140, 45)

    window.click(DEPTH)
    settled(window)
    found = len(cuts(window))
    hand.stroke(CUT)
    wait_until(lambda: len(cuts(window)) > found, "the new cut")
    keep(window, "puppet cut")
    hand.click(330, 205)
    for _ in range(3):
        choose(window, hand, "Further Apart")
    settled(window)
    keep(window, "puppet swapped")
    window.trigger("actionSave")
    wait_until(sidecar(project).exists, "the saved scene")
    (hint,) = hints_in(project)
    assert hint["front"] == "right", "the lower side, after the click"
    assert hint["frame"] == 1
    assert hint["amount"] > 0.05
    assert [hint["points"][end]["y"] for end in (0, -1)] == pytest.approx([205, 205], abs=2)

    window.click(LIT)
    settled(window)
    keep(window, "puppet corrected")
    after = hand.look(250, 180, 140, 45)
    assert np.abs(after - before).max() > 0.05, "the light changes near the cut"


def paint_arm_on(window: Pencil2D) -> None:
    """Choose the last entry of the arm's depth in the panel, which scrolls."""
    window.trigger("lampblack.panel.layers")
    left, top, _, height = window.rect("lampblack.panel")
    window.display.do("mousemove", "--sync", left + 20, top + height - 20)
    for _ in range(30):
        window.display.do("click", 5)
    keep(window, "puppet layers")
    window.click("lampblack.panel.body.Arm")
    window.key("End", "Return")


def scroll_back(window: Pencil2D) -> None:
    """The window is shared: the next test finds its panel as it was."""
    window.trigger("lampblack.panel.layers")
    left, top, _, height = window.rect("lampblack.panel")
    window.display.do("mousemove", "--sync", left + 20, top + height - 20)
    for _ in range(30):
        window.display.do("click", 4)


def test_an_arm_on_a_layer_of_its_own_shades_the_body(
    shared: SharedPencil2D, project: Path
) -> None:
    window = shared.open(project)
    hand = Hand(window)
    draw_puppet(window, hand)
    light_puppet(window, hand)
    below = (300, 285, 40, 10)
    shaded = hand.look(*below).mean()
    paint_arm_on(window)
    wait_until(lambda: not window.value("lampblack", "settled"), "another surface")
    settled(window)
    keep(window, "puppet painted")
    flat = hand.look(*below).mean()
    scroll_back(window)
    assert shaded < 0.8 * flat, f"{1 - shaded / flat:.0%} darker under the arm"
