"""The real Pencil2D, worker, network and Cycles, driven by mouse and keys in a virtual display.

Screenshots go to ``build/screenshots``. The example's camera shows 640 x 720 pixels, and its middle
is the middle of the canvas widget.
"""

from __future__ import annotations

import json
import os
import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lampblack.scene import Ambient, default_scene, encode_scene
from support.lamp import (
    SIZE,
    Canvas,
    brightness_of_sides,
    drag_light,
    keep,
    light_on_screen,
    light_up,
    project_in,
    settled,
    sidecar,
)
from support.processes import workers_of
from support.registration import luminance, offset
from support.window import Display, Pencil2D, SharedPencil2D, pencil2d, wait_until

TOOL = "lampblack.tool"
LIT, NORMALS, DEPTH, FLAT = (
    f"lampblack.panel.view.{n}" for n in ("lit", "normals", "depth", "flat")
)


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


def test_worker_killed_while_dragging(window: Pencil2D) -> None:
    canvas = Canvas(window)
    light_up(window)
    before = window.value("lampblack", "shownRevision")
    (pid,) = workers_of(window.process.pid)
    start = light_on_screen(window, canvas)
    path = [(start[0] + 4 * i, start[1] + 2 * i) for i in range(60)]
    for index in window.drag(path, pause=0.03):
        if index == 20:
            os.kill(pid, signal.SIGKILL)
    settled(window)
    assert window.value("lampblack", "shownRevision") > before
    assert workers_of(window.process.pid) != [pid]
    assert window.process.poll() is None


def test_scene_is_saved_and_found_again(
    shared: SharedPencil2D, display: Display, tmp_path: Path
) -> None:
    project = project_in(tmp_path)
    window = shared.open(project)
    light_up(window)
    drag_light(window, Canvas(window), (500, 100))
    assert not sidecar(project).exists()
    window.trigger("actionSave")
    wait_until(sidecar(project).exists, "the saved scene")
    (light,) = json.loads(sidecar(project).read_text())["lights"]
    assert (light["x"], light["y"]) == pytest.approx((500, 100), abs=2)
    with pencil2d(display, tmp_path / "second", project) as another:
        light_up(another)
        ((x, y),) = another.value("lampblack", "lightPlaces")
        assert (x, y) == pytest.approx((light["x"], light["y"]))


def test_floor_by_right_click_catches_a_shadow(window: Pencil2D) -> None:
    canvas = Canvas(window)
    light_up(window)
    drag_light(window, canvas, (90, 250))
    before = [luminance(canvas.crop(x, 625, 60, 20)).mean() for x in (120, 530)]
    window.click_at(*canvas.screen(60, 655), button=3)
    wait_until(lambda: window.find("lampblack.menu").get("seen"), "the menu")
    keep(window, "menu")
    choose(window, "lampblack.menu", "Put a Floor Here")
    settled(window)
    keep(window, "floor")
    near, far = (
        before[i] - luminance(canvas.crop(x, 625, 60, 20)).mean() for i, x in enumerate((120, 530))
    )
    assert far > 0.05, "a shadow lies away from the light"
    assert far > near + 0.05


def choose(window: Pencil2D, menu: str, entry: str) -> None:
    """Click an entry of an open menu."""
    entries = window.entries(menu)
    left, top, width, height = entries[entry]
    window.click_at(left + width / 2, top + height / 2)


def test_glossy_colour_shows_a_highlight(window: Pencil2D) -> None:
    canvas = Canvas(window)
    light_up(window)
    fur = "#4f8fb3"
    matt = canvas.crop(0, 0, *SIZE)
    window.click(f"lampblack.materials.glossy.{fur}")
    settled(window)
    keep(window, "glossy")
    glossy = canvas.crop(0, 0, *SIZE)
    gained = luminance(glossy) - luminance(matt)
    assert np.count_nonzero(gained > 0.1) > 300, "a highlight appears"
    # The belly is of another colour and stays as it was.
    belly = np.s_[500:560, 270:330]
    assert np.abs(gained[belly]).mean() < 0.01


def ink_at(canvas: Canvas, x: float, y: float) -> bool:
    """Whether the screen is dark there."""
    return float(luminance(canvas.crop(x - 2, y - 2, 4, 4)).min()) < 0.2


def test_light_follows_strokes_undo_and_frames(window: Pencil2D) -> None:
    canvas = Canvas(window)
    light_up(window)
    first = canvas.crop(0, 0, *SIZE)
    window.click("pencilButton")
    for _ in window.drag([canvas.screen(100 + 4 * i, 680) for i in range(30)]):
        pass
    light_up(window)

    def lit_with_the_line() -> bool:
        lit = window.value("lampblack.overlay", "showsPicture")
        return bool(lit and window.value("lampblack", "settled") and ink_at(canvas, 160, 680))

    # The stroke may be noticed only after the lamp was picked.
    wait_until(lit_with_the_line, "the new line in the lit picture", 60)
    keep(window, "stroke")
    window.trigger("actionUndo")
    wait_until(lambda: not ink_at(canvas, 160, 680), "the line's undoing")
    settled(window)
    assert np.abs(luminance(canvas.crop(0, 0, *SIZE)) - luminance(first)).mean() < 0.01
    for _ in range(6):
        window.trigger("actionNext_Frame")
    settled(window)
    keep(window, "frame 7")
    assert np.abs(luminance(canvas.crop(0, 0, *SIZE)) - luminance(first)).mean() > 0.02


def test_edits_of_the_light_are_undone(window: Pencil2D) -> None:
    canvas = Canvas(window)
    light_up(window)
    before = window.value("lampblack", "lightPlaces")
    drag_light(window, canvas, (500, 500))
    assert window.value("lampblack", "lightPlaces") != before
    window.key("ctrl+z")
    wait_until(lambda: window.value("lampblack", "lightPlaces") == before, "the light back")
    window.key("ctrl+shift+z")
    wait_until(lambda: window.value("lampblack", "lightPlaces") != before, "the drag again")


def test_surfaces_of_all_frames_play_lit(display: Display, tmp_path: Path, own_cache: Path) -> None:
    with pencil2d(display, tmp_path / "window", project_in(tmp_path)) as window:
        play_lit(window)


def play_lit(window: Pencil2D) -> None:
    light_up(window)
    window.trigger("lampblack.panel.generate")
    wait_until(lambda: window.value("lampblack.panel.progress", "visible"), "progress")
    keep(window, "generating")
    wait_until(lambda: not window.value("lampblack.panel.progress", "visible"), "surfaces", 240)
    # Seen once, a frame's picture is kept.
    for _ in range(15):
        settled(window)
        window.trigger("actionNext_Frame")
    settled(window)
    window.trigger("actionPlay")
    seen = [window.value("lampblack.overlay", "showsPicture") for _ in range(40)]
    keep(window, "playing")
    window.trigger("actionPlay")
    assert sum(seen) >= 36, f"lit in {sum(seen)} of {len(seen)} looks while playing"


VIEWS = {
    "zoom 33": ("actionZoom33",),
    "zoom 300": ("actionZoom300",),
    "turned": ("actionRotate_Clockwise",),
    "flipped": ("actionHorizontal_Flip",),
    "flipped and turned at 200": (
        "actionZoom200",
        "actionVertical_Flip",
        "actionRotate_Anticlockwise",
    ),
}


@pytest.mark.parametrize("scale", [1.0, 2.0])
def test_lit_picture_lies_on_the_drawing(
    shared: SharedPencil2D, display: Display, tmp_path: Path, scale: float
) -> None:
    """Under light from everywhere the lit picture shows the drawn colours; the one lamp is dark,
    and so far away that its handles are out of sight."""
    project = project_in(tmp_path)
    scene = default_scene(*SIZE)
    lamp = replace(scene.lights[0], x=-9000.0, power=0.0)
    scene = replace(scene, lights=(lamp,), ambient=Ambient(strength=1.0))
    sidecar(project).write_bytes(encode_scene(scene))
    if scale == 1:
        pictures_lie_on_the_drawing(shared.open(project), scale)
    else:
        with pencil2d(display, tmp_path / "window", project, scale=scale) as window:
            pictures_lie_on_the_drawing(window, scale)


def pictures_lie_on_the_drawing(window: Pencil2D, scale: float) -> None:
    light_up(window)
    for name, actions in VIEWS.items():
        for action in actions:
            window.trigger(action)
        window.click(LIT)
        settled(window)
        lit = window.canvas_picture()
        keep(window, f"{name} x{scale:g}")
        window.click(FLAT)
        wait_until(lambda: not window.value("lampblack.overlay", "showsPicture"), "the drawing")
        apart = offset(window.canvas_picture(), lit)
        assert max(map(abs, apart)) < 1.0, f"{name}: {apart}"
        window.trigger("actionReset_View")
        for action in actions:
            if action.endswith("Flip"):  # which the reset leaves
                window.trigger(action)
    window.click(LIT)
