"""Speed of the tool inside the real Pencil2D: ``python tests/measure_window.py``; with ``--start``,
the cold start alone; with ``--drags 1000``, its memory and its worker's over so many drags.

Prints JSON. Stalls are turns of Qt's event loop that took longer than the bound, by the clock and
by the thread's own processor time; Pencil2D's own work in them is part of the figures, so the same
movements with another tool are measured beside them.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import psutil

from lampblack.scene import default_scene, encode_scene
from support.paths import ROOT
from support.window import Display, Pencil2D, missing, pencil2d, wait_until

SIZE = (640, 720)


def settle(window: Pencil2D) -> None:
    wait_until(lambda: window.value("lampblack", "settled"), "a converged picture", 180)


def circle(window: Pencil2D, turns: float, steps: int) -> list[tuple[float, float]]:
    """Around the figure, from where the light stands."""
    left, top, width, height = window.rect("ScribbleArea")
    middle = (left + width / 2, top + height / 2)
    x, y = window.value("lampblack", "lightPlaces")[0]
    start = np.array([x - SIZE[0] / 2, y - SIZE[1] / 2])
    angles = np.linspace(0, 2 * np.pi * turns, steps)
    return [
        (
            middle[0] + start[0] * np.cos(a) - start[1] * np.sin(a),
            middle[1] + start[0] * np.sin(a) + start[1] * np.cos(a),
        )
        for a in angles
    ]


def resident(window: Pencil2D) -> dict[str, int]:
    """MiB of Pencil2D itself, and of the processes it started."""
    own = psutil.Process(window.process.pid)
    return {
        "pencil2d": own.memory_info().rss >> 20,
        "worker": sum(each.memory_info().rss for each in own.children(recursive=True)) >> 20,
    }


def drag(window: Pencil2D, turns: float, steps: int) -> None:
    for _ in window.drag(circle(window, turns, steps), pause=0.016):
        pass


def start_up(display: Display, folder: Path, project: Path) -> dict[str, float]:
    """Seconds from launch to the canvas, with and without the plugin, alternately."""
    taken: dict[bool, list[float]] = {True: [], False: []}
    for attempt in range(6):
        plugin = attempt % 2 == 0
        started = time.monotonic()
        with pencil2d(display, folder / f"start{attempt}", project, plugin=plugin):
            taken[plugin].append(time.monotonic() - started)
    return {
        "with": statistics.median(taken[True]),
        "without": statistics.median(taken[False]),
    }


def cold_start(display: Display, folder: Path) -> dict[str, Any]:
    with pencil2d(display, folder / "run", example_in(folder)) as window:
        return first_light(window)


def measure(display: Display, folder: Path) -> dict[str, Any]:
    project = example_in(folder)
    found: dict[str, Any] = {"start_up_s": start_up(display, folder, project)}
    with pencil2d(display, folder / "run", project) as window:
        window.click("pencilButton")
        window.stalls()
        path = circle(window, 1, 240)
        for x, y in path:
            display.do("mousemove", round(x), round(y), "sleep", 0.016)
        found["pointer_moved_with_pencil"] = window.stalls()
        found["first_light_s"] = first_light(window)
        window.latency("lampblack")
        window.stalls()
        drag(window, 2, 480)
        found["dragging"] = window.stalls()
        latency = sorted(window.latency("lampblack"))
        found["drag_to_lit_ms"] = {
            "p50": statistics.median(latency),
            "p95": latency[int(0.95 * len(latency))],
            "pictures": len(latency),
        }
        settle(window)
        window.stalls()
        for _ in range(8):
            window.trigger("actionNext_Frame")
            time.sleep(0.4)
        found["scrubbing"] = window.stalls()
        settle(window)
        window.stalls()
        window.trigger("lampblack.panel.generate")
        time.sleep(8)
        found["generating"] = window.stalls()
        found["stroke"] = stroke(window)
    return found


def first_light(window: Pencil2D) -> dict[str, float]:
    """Seconds from the click on the lamp, when no worker runs yet, to its instant shading, to its
    first lit picture, and to the converged one."""
    found: dict[str, float] = {}

    def note(name: str) -> bool:
        shown = window.find("lampblack.overlay")["properties"]
        for seen, property_name in (("shaded", "showsStandIn"), ("lit", "showsPicture")):
            if shown[property_name]:
                found.setdefault(seen, time.monotonic() - started)
        return name in found

    started = time.monotonic()
    window.click("lampblackButton")
    wait_until(lambda: note("lit"), "a lit picture", 180)
    settle(window)
    return found | {"converged": time.monotonic() - started}


def stroke(window: Pencil2D) -> dict[str, Any]:
    window.click("pencilButton")
    time.sleep(1)
    left, top, *_ = window.rect("ScribbleArea")
    window.stalls()
    for _ in window.drag([(left + 200 + 4 * i, top + 300 + 3 * i) for i in range(40)]):
        pass
    time.sleep(2)
    return window.stalls()


def endurance(display: Display, folder: Path, drags: int) -> dict[str, Any]:
    """Resident memory at every tenth of so many short drags, each to lit pixels."""
    with pencil2d(display, folder / "run", example_in(folder)) as window:
        window.click("lampblackButton")
        settle(window)
        seen, pictures = [resident(window)], 0
        for index in range(drags):
            (x, y), *path = circle(window, 0.02, 6)
            moves = [part for p in path for part in ("mousemove", *map(round, p), "sleep", 0.016)]
            start = ("mousemove", round(x), round(y), "mousedown", 1, "sleep", 0.016)
            display.do(*start, *moves, "mouseup", 1, "sleep", 0.05)
            if (index + 1) % max(1, drags // 10) == 0:
                pictures += len(window.latency("lampblack"))
                window.stalls()  # the probe keeps each turn until it is asked
                seen.append(resident(window))
                sys.stderr.write(f"{index + 1} of {drags}: {seen[-1]}\n")
        return {"drags": drags, "pictures": pictures, "resident_mib": seen}


def example_in(folder: Path) -> Path:
    """A copy of the example with the light of a new scene."""
    project = folder / "walk.pclx"
    shutil.copy(ROOT / "examples" / "lamplighter.pclx", project)
    scene = encode_scene(default_scene(*SIZE))
    (folder / "walk.pclx.lampblack.json").write_bytes(scene)
    return project


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--drags", type=int, default=0)
    parser.add_argument("--start", action="store_true")
    arguments = parser.parse_args()
    # Glib's event loop does not tell when it works and when it waits.
    os.environ.setdefault("QT_NO_GLIB", "1")
    if missing():
        sys.stderr.write(f"missing: {missing()}\n")
        return 1
    with tempfile.TemporaryDirectory() as folder:
        display = Display(Path(folder))
        try:
            if arguments.drags:
                found = endurance(display, Path(folder), arguments.drags)
            elif arguments.start:
                found = cold_start(display, Path(folder))
            else:
                found = measure(display, Path(folder))
        finally:
            display.close()
    sys.stdout.write(json.dumps(found, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
