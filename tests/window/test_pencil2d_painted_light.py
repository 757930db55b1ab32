"""A layer called Light, in the real Pencil2D: its strokes are light in the live picture."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np

from support.lamp import Canvas, keep, light_up, project_in
from support.projects import image, layer, png
from support.window import SharedPencil2D

PAINT = (255, 208, 96, 255)
STREAK = (290, 470, 60, 60)
"""Over the figure's belly: x, y, width, height on the canvas."""


def painted_project_in(folder: Path) -> Path:
    """The example with a streak of light in all frames."""
    x, y, width, height = STREAK
    streak = layer(7, "Light", [image(1, "streak.png", x - 320, y - 360)])
    project, example = folder / "painted.pclx", folder / "example"
    example.mkdir()
    with zipfile.ZipFile(project_in(example)) as source, zipfile.ZipFile(project, "w") as target:
        for name in source.namelist():
            content = source.read(name)
            if name == "main.xml":
                content = content.replace(b"</object>", streak.encode() + b"</object>")
            target.writestr(name, content)
        target.writestr("data/streak.png", png(np.full((height, width, 4), PAINT, np.uint8)))
    return project


def test_strokes_of_light_light_the_figure(shared: SharedPencil2D, tmp_path: Path) -> None:
    window = shared.open(project_in(tmp_path))
    light_up(window)
    canvas = Canvas(window)
    before = canvas.crop(*STREAK)
    window = shared.open(painted_project_in(tmp_path))
    light_up(window)
    keep(window, "painted light")
    after = canvas.crop(*STREAK)
    red, _, blue = after.mean(axis=(0, 1)) / before.mean(axis=(0, 1))
    assert red > 1.05, "it is lit"
    assert red > 1.1 * blue, "in the colour of the paint"
    assert not (after == PAINT[:3]).all(axis=2).any(), "the paint itself is not seen"
