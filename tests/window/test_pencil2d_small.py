"""Pencil2D with the lamp on small screens: all of it fits, and docks stay as they were left."""

from __future__ import annotations

from pathlib import Path

import pytest

import support.window
from support.lamp import keep, project_in
from support.window import Display, Pencil2D, pencil2d, wait_until

BELOW = ("DisplayOptionWidget", "OnionSkinWidget")
"""The dock below the tool options: the first that there is. Pencil2D 0.7 has the second only."""


def light_is_in_use(window: Pencil2D) -> bool:
    return bool(window.value("lampblackButton", "checked"))


@pytest.mark.parametrize("size", [(1366, 768), (1024, 600)])
def test_the_window_fits_a_small_screen(
    size: tuple[int, int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(support.window, "WINDOW", (size[0] - 30, size[1] - 30))
    small = Display(tmp_path, size)
    try:
        with pencil2d(small, tmp_path / "window", project_in(tmp_path)) as window:
            window.trigger("lampblack.tool")
            wait_until(lambda: light_is_in_use(window), "the lamp in use")
            _, top, _, height = window.rect("MainWindow2")
            assert top + height <= size[1]
            wait_until(lambda: shown_height(window) >= size[1] / 4, "room for the panel")
            keep(window, f"panel {size[0]}x{size[1]}")
            window.click("pencilButton")
            wait_until(lambda: not window.value("lampblack.panel", "visible"), "the lamp away")
            if size[1] >= 700:  # on a lower screen it is a tab for good
                below = next(name for name in BELOW if window.of_class(name))
                wait_until(lambda: window.of_class(below).get("seen"), "docks back")
    finally:
        small.close()


def shown_height(window: Pencil2D) -> int:
    """Of the part of the panel that scrolls."""
    return int(window.find("lampblack.panel")["rect"][3])


def test_materials_stay_closed(display: Display, tmp_path: Path) -> None:
    project = project_in(tmp_path)
    with pencil2d(display, tmp_path, project) as window:
        wait_until(lambda: window.find("lampblack.materials"), "the materials")
        window.set("lampblack.materials", "visible", False)
        window.trigger("actionExit")
        window.process.wait(30)
    with pencil2d(display, tmp_path, project) as window:
        wait_until(lambda: window.find("lampblack.materials"), "the materials")
        assert not window.value("lampblack.materials", "visible")
