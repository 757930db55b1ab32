"""Speed of the tool inside the real Pencil2D: ``python tests/measure_window.py [--drags 1000]``.

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

from lampblack.scene import default_scene, encode_scene
from window import ROOT, Display, Pencil2D, missing, pencil2d, wait_until

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


def resident(window: Pencil2D) -> int:
    """MiB of Pencil2D itself."""
    status = Path(f"/proc/{window.process.pid}/status").read_text()
    return int(status.split("VmRSS:")[1].split()[0]) // 1024


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


def measure(display: Display, folder: Path, drags: int) -> dict[str, Any]:
    project = folder / "walk.pclx"
    shutil.copy(ROOT / "examples" / "lamplighter.pclx", project)
    scene = encode_scene(default_scene(*SIZE))
    (folder / "walk.pclx.lampblack.json").write_bytes(scene)
    found: dict[str, Any] = {"start_up_s": start_up(display, folder, project)}
    with pencil2d(display, folder / "run", project) as window:
        window.click("pencilButton")
        window.stalls()
        path = circle(window, 1, 240)
        for x, y in path:
            display.do("mousemove", round(x), round(y), "sleep", 0.016)
        found["pointer_moved_with_pencil"] = window.stalls()
        started = time.monotonic()
        window.click("lampblackButton")
        settle(window)
        found["first_light_s"] = time.monotonic() - started
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
        if drags:
            found["resident_mib"] = endurance(window, drags)
    return found


def stroke(window: Pencil2D) -> dict[str, Any]:
    window.click("pencilButton")
    time.sleep(1)
    left, top, *_ = window.rect("ScribbleArea")
    window.stalls()
    for _ in window.drag([(left + 200 + 4 * i, top + 300 + 3 * i) for i in range(40)]):
        pass
    time.sleep(2)
    return window.stalls()


def endurance(window: Pencil2D, drags: int) -> list[int]:
    """Resident MiB at every tenth of so many short drags."""
    window.click("lampblackButton")
    settle(window)
    seen = [resident(window)]
    for index in range(drags):
        path = circle(window, 0.02, 6)
        for _ in window.drag(path, pause=0.01):
            pass
        if (index + 1) % max(1, drags // 10) == 0:
            seen.append(resident(window))
    return seen


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--drags", type=int, default=0)
    arguments = parser.parse_args()
    # Glib's event loop does not tell when it works and when it waits.
    os.environ.setdefault("QT_NO_GLIB", "1")
    if missing():
        sys.stderr.write(f"missing: {missing()}\n")
        return 1
    with tempfile.TemporaryDirectory() as folder:
        display = Display(Path(folder))
        try:
            found = measure(display, Path(folder), arguments.drags)
        finally:
            display.close()
    sys.stdout.write(json.dumps(found, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
