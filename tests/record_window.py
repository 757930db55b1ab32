"""Take the manual's pictures of the real Pencil2D, and record a dragged light, and strokes in it.

python tests/record_window.py docs/images          # all
python tests/record_window.py docs/images depth    # one of PARTS
"""

from __future__ import annotations

import math
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import closing
from pathlib import Path

import numpy as np
from PIL import Image

import support.window
from lampblack.atomic import atomic_file
from support.lamp import Canvas, drag_light, light_up, project_in, settled
from support.window import Display, Pencil2D, missing, pencil2d, wait_until

VIEW = "lampblack.panel.view."
FUR = "#4f8fb3"
PART = (170.0, 250.0, 380.0, 380.0)
"""What is recorded of the canvas: x, y, width, height."""
SIDE, COLOURS = 340, 255
OCTREE = Image.Quantize.FASTOCTREE
"""Keeps small patches of other colours, such as the lantern."""
EVERY = 4
"""Moves of the pen from one picture to the next."""
MOVE_MS, PAUSE_MS, LIT_MS = 60, 300, 2500

WHOLE = (0.0, 50.0, 640.0, 620.0)
DRAGGED = (480, 465)
MOVES, FOLLOW_S, DRAG_MS = 18, 0.4, 80
"""Steps of the dragged light, seconds that each is given to be lit, and how long it is shown."""
SCARF = (335.0, 430.0)
"""Near the edge of the scarf on the belly; canvas pixels."""

Place = tuple[float, float]


def take(window: Pencil2D, folder: Path, name: str) -> None:
    """Write the window to ``pencil2d-NAME.png``."""
    left, top, width, height = window.rect("MainWindow2")
    picture = Image.fromarray(window.display.screenshot(left, top, width, height))
    with atomic_file(folder / f"pencil2d-{name}.png") as file:
        picture.save(file, "PNG", optimize=True)
    sys.stderr.write(f"{name}\n")


def choose(window: Pencil2D, menu: str, entry: str) -> None:
    left, top, width, height = window.entries(menu)[entry]
    window.click_at(left + width / 2, top + height / 2)


def take_light_and_floor(window: Pencil2D, folder: Path) -> None:
    canvas = Canvas(window)
    light_up(window)
    take(window, folder, "lit")
    drag_light(window, canvas, (90, 250))
    window.click_at(*canvas.screen(60, 655), button=3)
    wait_until(lambda: window.find("lampblack.menu").get("seen"), "the menu")
    take(window, folder, "menu")
    choose(window, "lampblack.menu", "Put a Floor Here")
    settled(window)
    take(window, folder, "floor")
    window.click(f"lampblack.materials.glossy.{FUR}")
    settled(window)
    take(window, folder, "glossy")
    window.click(VIEW + "normals")
    settled(window)
    take(window, folder, "normals")
    window.click(VIEW + "lit")
    settled(window)


def take_keys(window: Pencil2D, folder: Path) -> None:
    canvas = Canvas(window)
    light_up(window)
    drag_light(window, canvas, (40, 300))
    window.click("lampblack.panel.keys.here")
    for place, frames in (((320, 60), 4), ((600, 300), 4)):
        for _ in range(frames):
            window.trigger("actionNext_Frame")
        settled(window)
        drag_light(window, canvas, place)
    for _ in range(2):
        window.trigger("actionPrevious_Frame")
    settled(window)
    take(window, folder, "keys")


def take_depth(window: Pencil2D, folder: Path) -> None:
    """The view *Depth*, with one edge that was clicked."""
    light_up(window)
    window.click(VIEW + "depth")
    settled(window)
    places = [place for cut in window.value("lampblack", "cutPlaces") for place in cut]
    edge = min(places, key=lambda place: math.dist(place, SCARF))
    window.click_at(*Canvas(window).screen(*edge))
    wait_until(lambda: not window.value("lampblack", "settled"), "another surface")
    settled(window)
    take(window, folder, "depth")
    window.click(VIEW + "lit")
    settled(window)


def record_drag(window: Pencil2D, folder: Path) -> None:
    """Write ``pencil2d-drag.gif``: a light is dragged around the character's head."""
    canvas = Canvas(window)
    light_up(window)
    drag_light(window, canvas, around(0))
    shown = []
    places = [canvas.screen(*around(step / MOVES)) for step in range(MOVES + 1)]
    for _ in window.drag(places, pause=FOLLOW_S):
        picture = Image.fromarray(canvas.crop(*WHOLE))
        shown.append((picture.resize(DRAGGED, Image.Resampling.LANCZOS), DRAG_MS))
    settled(window)
    write_gif(folder / "pencil2d-drag.gif", [*shown, *shown[::-1]])


def around(share: float) -> Place:
    """A place on the way of the light over the head; canvas pixels."""
    turn = math.pi * (1 + share)
    return 320 + 250 * math.cos(turn), 300 + 200 * math.sin(turn)


def write_gif(path: Path, shown: list[tuple[Image.Image, int]]) -> None:
    """Write pictures, each with the milliseconds that it is shown."""
    few = [shown[index * (len(shown) - 1) // 4][0] for index in range(5)]
    palette = Image.fromarray(np.concatenate(few)).quantize(COLOURS, OCTREE)
    first, *others = (
        picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture, _ in shown
    )
    with atomic_file(path) as file:
        first.save(
            file, "GIF", save_all=True, append_images=others, loop=0,
            duration=[milliseconds for _, milliseconds in shown],
        )  # fmt: skip


def strokes() -> Iterator[list[Place]]:
    """A heart on the belly, and stripes on the fur beside it; canvas pixels."""
    for side in (-1, 1):
        turns = [math.pi * step / 24 for step in range(25)]
        yield [
            (
                330 + side * 30 * math.sin(turn) ** 3,
                540 - 1.9 * (13 * math.cos(turn) - 5 * math.cos(2 * turn) - 2 * math.cos(3 * turn)),
            )
            for turn in turns
        ]
    for line in range(3):
        yield [(192 + 2.5 * i, 470 + 24 * line + i / 2) for i in range(17)]
    for line in range(3):
        yield [(452 + 2.5 * i, 478 + 22 * line - i / 2) for i in range(15)]


def record_drawing(window: Pencil2D, folder: Path) -> None:
    """Write ``pencil2d-drawing.gif``: the light stays while lines are drawn, and then follows."""
    canvas = Canvas(window)
    shown: list[tuple[Image.Image, int]] = []

    def shoot(milliseconds: int) -> None:
        picture = Image.fromarray(canvas.crop(*PART))
        shown.append((picture.resize((SIDE, SIDE), Image.Resampling.LANCZOS), milliseconds))

    light_up(window)
    window.set("lampblack.keep_light", "checked", True)
    window.click("pencilButton")
    shoot(2 * PAUSE_MS)
    for stroke in strokes():
        places = [canvas.screen(x, y) for x, y in stroke]
        for move in window.drag(places, pause=0.02):
            if move % EVERY == 0:
                shoot(MOVE_MS)
        shoot(PAUSE_MS)
    window.click("lampblackButton")
    settled(window)
    shoot(LIT_MS)
    write_gif(folder / "pencil2d-drawing.gif", shown)


def take_panel(window: Pencil2D, folder: Path) -> None:
    """On a small screen, in two tones."""
    light_up(window)
    window.click("lampblack.panel.look.hard-cel")
    settled(window)
    take(window, folder, "panel")


SIZE, SMALL = (1240, 860), (1366, 748)
"""Of the window without its frame."""
PARTS = {
    "drawing": (record_drawing, SIZE),
    "floor": (take_light_and_floor, SIZE),
    "keys": (take_keys, SIZE),
    "depth": (take_depth, SIZE),
    "drag": (record_drag, SIZE),
    "panel": (take_panel, SMALL),
}


def main(target: Path, wanted: Sequence[str]) -> int:
    if missing():
        sys.stderr.write(f"missing: {missing()}\n")
        return 1
    for part in wanted or PARTS:
        make, support.window.WINDOW = PARTS[part]
        with tempfile.TemporaryDirectory() as name, closing(Display(Path(name))) as display:
            folder = Path(name)
            with pencil2d(display, folder, project_in(folder)) as window:
                make(window, target)
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2:]))
