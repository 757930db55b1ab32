"""Layers that are not lit, in the real window: under and over the lit picture, as drawn."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import numpy as np

from lampblack.scene import default_scene, encode_scene
from support.lamp import SIZE, Canvas, brightness_of_sides, drag_light, keep, light_up, sidecar
from support.lamp import project_in as example_in
from support.projects import Picture, image, layer, png
from support.window import SharedPencil2D

SKY, SIGN = (120, 190, 230), (90, 40, 120)
SIGN_AT = (280, 560, 80, 60)
"""Over the figure's belly: x, y, width, height on the canvas."""


def plain(width: int, height: int, colour: tuple[int, int, int]) -> Picture:
    return np.full((height, width, 4), (*colour, 255), np.uint8)


def staged_project_in(folder: Path) -> Path:
    """The example's figure between a sky and a sign, neither of which is lit."""
    project, example = folder / "stage.pclx", folder / "example"
    example.mkdir()
    x, y, width, height = SIGN_AT
    sky = layer(7, "Sky", [image(1, "sky.png", -320, -360)])
    sign = layer(8, "Sign", [image(1, "sign.png", x - 320, y - 360)])
    with zipfile.ZipFile(example_in(example)) as source, zipfile.ZipFile(project, "w") as target:
        for name in source.namelist():
            content = source.read(name)
            if name == "main.xml":
                figure = content.index(b'<layer id="2"')
                end = content.index(b"</object>")
                content = content[:figure] + sky.encode() + content[figure:end] + sign.encode()
                content += source.read(name)[end:]
            target.writestr(name, content)
        target.writestr("data/sky.png", png(plain(640, 720, SKY)))
        target.writestr("data/sign.png", png(plain(width, height, SIGN)))
    return project


def test_background_and_foreground_stay_as_drawn(shared: SharedPencil2D, tmp_path: Path) -> None:
    project = staged_project_in(tmp_path)
    scene = json.loads(encode_scene(default_scene(*SIZE)))
    scene["pencil2d_layers"] = {"Lamplighter": "character"}
    sidecar(project).write_text(json.dumps(scene))
    window = shared.open(project)
    light_up(window)
    canvas = Canvas(window)
    keep(window, "background")
    x, y, width, height = SIGN_AT
    for corner in (canvas.crop(20, 640, 30, 30), canvas.crop(590, 640, 30, 30)):
        assert (corner == SKY).all()
    sign = canvas.crop(x + 4, y + 4, width - 8, height - 8)
    assert (sign == SIGN).all()
    left, right = brightness_of_sides(canvas)
    drag_light(window, canvas, (600, 300))
    now_left, now_right = brightness_of_sides(canvas)
    assert now_right / now_left > 1.1 * right / left
    assert (canvas.crop(x + 4, y + 4, width - 8, height - 8) == SIGN).all()
