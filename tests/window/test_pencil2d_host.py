"""What differs between Pencil2D 0.6 and 0.7: the palette, keys, the status bar, guides, opacity."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from support.lamp import (
    SIZE,
    Canvas,
    drag_light,
    keep,
    light_up,
    project_in,
    settled,
)
from support.registration import luminance
from support.window import Display, Pencil2D, pencil2d, wait_until

KEYS = ("Left", "Right", "d", "ctrl+z", "ctrl+shift+z", "shift", "alt", "ctrl", "space", "Escape")


def in_use(window: Pencil2D) -> bool:
    return bool(window.value("lampblackButton", "checked"))


def checked_tools(window: Pencil2D) -> list[str]:
    """The program's own tools whose button is down."""
    names = (f"{name}Button" for name in ("pencil", "pen", "brush", "hand", "eraser", "eyedropper"))
    return [name for name in names if window.value(name, "checked")]


def test_the_lamp_stays_whatever_key_is_released(window: Pencil2D) -> None:
    light_up(window)
    left, top, width, height = window.rect("ScribbleArea")
    window.display.do("mousemove", "--sync", left + width // 4, top + height // 2)
    for key in KEYS:
        window.key(key)
        settled(window)
        assert in_use(window), key
        assert checked_tools(window) == [], key
    window.trigger("actionSave")
    wait_until(lambda: not window.of_class("MainWindow2")["properties"]["windowModified"], "saving")
    window.display.do("windowminimize", "--sync", window.window)
    window.display.do("windowactivate", "--sync", window.window)
    settled(window)
    assert in_use(window)
    assert checked_tools(window) == []


def test_one_tool_is_in_use(window: Pencil2D) -> None:
    """By button and by key, also the tool that was in use before the lamp."""
    for leave, tool in (("n", "pencilButton"), ("p", "penButton"), ("", "pencilButton")):
        light_up(window)
        assert checked_tools(window) == []
        if leave:
            window.key(leave)
        else:
            window.click(tool)
        wait_until(lambda: not in_use(window), "the lamp put away")
        wait_until(lambda tool=tool: checked_tools(window) == [tool], tool)
        assert not window.find("lampblack.panel.view.lit")["seen"]
    places = window.value("lampblack", "lightPlaces")
    canvas = Canvas(window)
    for _ in window.drag([canvas.screen(100 + 4 * i, 680) for i in range(30)]):
        pass
    assert window.value("lampblack", "lightPlaces") == places, "the pencil draws"
    wait_until(lambda: luminance(canvas.crop(158, 678, 4, 4)).min() < 0.2, "the stroke")


def test_the_first_lamp_leaves_the_canvas_where_it_is(display: Display, tmp_path: Path) -> None:
    with pencil2d(display, tmp_path / "window", project_in(tmp_path)) as window:
        before = window.rect("ScribbleArea")
        keep(window, "before the lamp")
        light_up(window)
        keep(window, "first lamp")
        after = window.rect("ScribbleArea")
        assert abs(after[0] - before[0]) <= 30, "a panel needs some room"
        assert abs(after[2] - before[2]) <= 30
        window.click("pencilButton")
        wait_until(lambda: not in_use(window), "the lamp put away")
        assert window.rect("ScribbleArea")[2] == pytest.approx(before[2], abs=30)


def test_guides_lie_over_the_lit_picture(window: Pencil2D) -> None:
    if not window.find("actionThirds"):
        pytest.skip("this Pencil2D has no guides")
    light_up(window)
    canvas = Canvas(window)
    drag_light(window, canvas, (600, 300))
    lit = canvas.crop(0, 0, *SIZE)
    window.trigger("actionThirds")
    third = SIZE[1] // 3

    def crossed() -> bool:
        changed = np.abs(canvas.crop(0, 0, *SIZE).astype(int) - lit).max(axis=2) > 30
        return bool(changed[third - 2 : third + 3].any(axis=0).mean() > 0.3)

    wait_until(crossed, "the line of a third over the lit picture")
    keep(window, "guides")
    changed = np.abs(canvas.crop(0, 0, *SIZE).astype(int) - lit).max(axis=2) > 30
    assert changed.mean() < 0.02, "lines, and nothing else"
    window.trigger("actionThirds")
    wait_until(lambda: not crossed(), "the plain picture")


def test_the_opacity_of_a_layer_is_noticed(window: Pencil2D) -> None:
    if not window.find("actionChangeLayerOpacity"):
        pytest.skip("this Pencil2D sets no opacity")
    light_up(window)
    canvas = Canvas(window)
    before = luminance(canvas.crop(205, 470, 40, 60)).mean()
    window.trigger("actionChangeLayerOpacity")
    wait_until(lambda: window.of_class("LayerOpacityDialog").get("seen"), "the dialog")
    window.set("rbActiveLayer", "checked", True)
    window.set("chooseOpacitySlider", "value", 150)
    window.trigger("btnClose")

    def paler() -> bool:
        pale = luminance(canvas.crop(205, 470, 40, 60)).mean() > before + 0.05
        return bool(pale and window.value("lampblack", "settled"))

    wait_until(paler, "a paler lit picture")
    keep(window, "opacity")
    for _ in range(6):  # a frame of another drawing
        window.trigger("actionNext_Frame")
    settled(window)
    assert luminance(canvas.crop(205, 470, 40, 60)).mean() > before + 0.05


def test_the_colour_box_of_the_program_chooses_the_colour_of_a_light(window: Pencil2D) -> None:
    window.click("lampblackButton")
    wait_until(lambda: in_use(window), "the lamp in use")
    button = "lampblack.panel.colour"
    window.click(button)
    wait_until(lambda: window.find(button + ".dialog").get("seen"), "the dialog")
    left, top, width, height = window.resting_rect("ColorWheel")
    chosen = {"#ffffff"}

    def colour() -> str:
        return str(window.value(button, "accessibleDescription"))

    for share in (0.2, -0.2):  # of the wheel, from its middle: inside its square
        across = share / 2 * min(width, height)
        window.click_at(left + width / 2 + across, top + height / 2)
        wait_until(lambda: colour() not in chosen, "a colour of the colour box")
        chosen.add(colour())
    keep(window, "colour box of the program")
