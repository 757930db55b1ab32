"""Lights on the timeline, in the real Pencil2D: keyed, followed while scrubbing, rendered alike."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lampblack.scene import decode_scene
from lampblack.timeline import scene_at
from support.command_line import Run
from support.lamp import (
    Canvas,
    brightness_of_sides,
    drag_light,
    keep,
    light_up,
    project_in,
    settled,
    sidecar,
)
from support.registration import luminance
from support.window import Display, Pencil2D, SharedPencil2D, pencil2d, wait_until

HERE = "lampblack.panel.keys.here"
LEFT, RIGHT = (40, 300), (600, 300)


def step(window: Pencil2D, frames: int) -> None:
    action = "actionNext_Frame" if frames > 0 else "actionPrevious_Frame"
    for _ in range(abs(frames)):
        window.trigger(action)
    settled(window)


def place(window: Pencil2D) -> tuple[float, float]:
    ((x, y),) = window.value("lampblack", "lightPlaces")
    return x, y


def sides_of(picture: Path) -> tuple[float, float]:
    """What ``brightness_of_sides`` measures, of a rendered frame."""
    with Image.open(picture) as opened:
        white = Image.new("RGBA", opened.size, "white")
        grey = luminance(np.asarray(Image.alpha_composite(white, opened.convert("RGBA")))[..., :3])
    return float(grey[470:530, 205:245].mean()), float(grey[400:460, 455:495].mean())


def test_a_keyed_light_moves_in_the_window_as_on_the_command_line(
    shared: SharedPencil2D, tmp_path: Path, run: Run
) -> None:
    project = project_in(tmp_path)
    seen = {}
    window = shared.open(project)
    canvas = Canvas(window)
    light_up(window)
    drag_light(window, canvas, LEFT)
    window.click(HERE)
    settled(window)
    seen[1] = brightness_of_sides(canvas)
    step(window, 8)
    assert place(window) == pytest.approx(LEFT, abs=2), "held after the only key"
    drag_light(window, canvas, RIGHT)
    seen[9] = brightness_of_sides(canvas)
    keep(window, "keyed at 9")
    step(window, -4)
    between = place(window)
    assert between == pytest.approx((320, 300), abs=2), "half way"
    seen[5] = brightness_of_sides(canvas)
    keep(window, "keyed at 5")
    step(window, -1)
    seen[4] = brightness_of_sides(canvas)

    window.click("lampblack.panel.keys.next")
    wait_until(lambda: place(window) == pytest.approx(RIGHT, abs=2), "the key at 9")
    window.key("ctrl+z")
    wait_until(lambda: place(window) == pytest.approx(LEFT, abs=2), "no key at 9")
    window.key("ctrl+shift+z")
    wait_until(lambda: place(window) == pytest.approx(RIGHT, abs=2), "the key again")
    window.trigger("actionSave")
    wait_until(sidecar(project).exists, "the saved scene")

    # Frames 1 to 4 show one drawing: there only the light has moved.
    towards_right = {frame: right - left for frame, (left, right) in seen.items()}
    assert towards_right[4] > towards_right[1] + 0.03
    scene = decode_scene(sidecar(project).read_bytes())
    assert [key.frame for key in scene.lights[0].keys] == [1, 9]
    light = scene_at(scene, 5).lights[0]
    assert (light.x, light.y) == pytest.approx(between, abs=1e-6)
    # Previews are not smoothed over time. The two are of different qualities.
    frames = ["--frames", "1,4,5,9", "--no-steady"]
    assert run("render", project, "-o", tmp_path / "lit", *frames).code == 0
    for frame, sides in seen.items():
        (picture,) = (tmp_path / "lit").glob(f"*{frame:04d}.png")
        assert sides_of(picture) == pytest.approx(sides, abs=0.01), f"frame {frame}"


def test_new_and_open_ask_for_the_light(display: Display, tmp_path: Path) -> None:
    project = project_in(tmp_path)
    with pencil2d(display, tmp_path / "window", project) as window:
        light_up(window)
        window.set("lampblack.panel.power.field", "value", 2.5)

        def asked() -> bool:
            return bool(window.of_class("QMessageBox").get("seen"))

        def refused() -> bool:
            window.key("Escape")  # which a window that just came may miss
            return not asked()

        window.key("ctrl+o")
        wait_until(asked, "a question")
        wait_until(refused, "its end")
        left, top, _, height = window.rect("QMenuBar")
        window.click_at(left + 16, top + height / 2)
        wait_until(lambda: window.find("menuFile").get("seen"), "the menu")
        keep(window, "file menu")
        window.key("Down", "Return")
        wait_until(asked, "a question")
        assert not sidecar(project).exists()

        def saved() -> bool:
            window.key("Return")
            return sidecar(project).exists()

        wait_until(saved, "the saved light")
    (light,) = decode_scene(sidecar(project).read_bytes()).lights
    assert light.power == 2.5
