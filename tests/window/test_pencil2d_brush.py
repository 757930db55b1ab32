"""The brush of the Depth view, in the real Pencil2D: the surface under it, and its undo."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from support.lamp import Canvas, keep, light_up, settled, sidecar
from support.registration import luminance
from support.window import Pencil2D, wait_until

LIT, DEPTH = (f"lampblack.panel.view.{name}" for name in ("lit", "depth"))
BAR = "lampblack.brush_bar"
BELLY = [(270.0 + 4 * i, 500.0) for i in range(25)]
"""A stroke, pixels of the canvas."""


def test_a_stroke_shapes_the_surface_and_is_undone(window: Pencil2D, tmp_path: Path) -> None:
    project = tmp_path / "walk.pclx"
    light_up(window)
    assert not window.find(BAR).get("seen")
    window.click(DEPTH)
    settled(window)
    canvas = Canvas(window)
    look = BELLY[0][0], BELLY[0][1] - 24, 55, 20  # away from the line and the pointer

    def above() -> float:
        """The brightness above the stroke, where its bump faces the light of the picture."""
        return float(luminance(canvas.crop(*look)).mean())

    plain = above()
    window.click(f"{BAR}.bump")
    for _ in window.drag([canvas.screen(*at) for at in BELLY], pause=0.02):
        keep(window, "brush drawing")
    wait_until(lambda: not window.value("lampblack", "settled"), "the change")
    settled(window)
    keep(window, "brush bump")
    bumped = above()
    window.key("ctrl+s")
    wait_until(lambda: sidecar(project).exists(), "the project's scene")
    (stroke,) = json.loads(sidecar(project).read_text())["depth"]["strokes"]
    assert stroke["brush"] == "bump"
    assert np.hypot(stroke["points"][0]["x"] - 270, stroke["points"][0]["y"] - 500) < 3
    window.key("ctrl+z")
    settled(window)
    keep(window, "brush undone")
    assert bumped > plain + 0.01
    assert abs(above() - plain) < 0.003
    window.click(f"{BAR}.step")
    window.click(LIT)  # the window is shared: the next test finds its view as it was
