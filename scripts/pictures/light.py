"""Pictures of light: the example, looks, painted light, and moving pictures."""

from __future__ import annotations

import os
import zipfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw
from sheets import IMAGES, SCENE, STILL, lampblack, opened, save

from lampblack.atomic import atomic_file
from lampblack.scene import (
    Ambient,
    AreaLight,
    Canvas,
    Floor,
    LightKey,
    PaintedLight,
    Scene,
    encode_scene,
)

LOOKS = ("smooth", "soft-cel", "hard-cel", "two-tone-rim")
RIGS = {"key": "#f4efe6", "sunset": "#f4cba7", "moon": "#3f4a80"}
"""Each rig with the paper that its pictures lie on."""
OTHERS = ("kid", "dino", "cat")
COLOURS, OCTREE = 255, Image.Quantize.FASTOCTREE
"""Of a moving picture; an octree keeps small patches of other colours."""
PAINT = (
    ("#ffd27a", 34, ((400, 640), (420, 690), (470, 730), (540, 750))),
    ("#ffd27a", 24, ((560, 560), (610, 580), (650, 625))),
    ("#ff4030", 26, ((560, 200), (600, 185), (650, 195), (690, 235))),
)
"""Strokes of light on the example: colour, width and places, in its pixels."""


def stills(work: Path) -> None:
    """The example as drawn, its depth, and lit in two looks."""
    scene = ("--scene", SCENE, "--quality", "medium")
    lampblack("render", STILL, "-o", work / "lit", *scene)
    lampblack("render", STILL, "-o", work / "cel", *scene, "--look", "hard-cel")
    lampblack("depth", STILL, "-o", work / "depth.png")
    drawn, lit, cel = STILL, work / "lit" / STILL.name, work / "cel" / STILL.name
    save("lamplighter.png", [[opened(drawn), opened(lit)]])
    save("before-after-cel.jpg", [[opened(path, side=400) for path in (drawn, lit, cel)]])
    depth = opened(work / "depth.png", side=520)
    save("depth.jpg", [[opened(drawn, side=520), depth, opened(lit, side=520)]])


def floor_below(drawing: Path) -> int:
    """The canvas line of the lowest pixel that is drawn."""
    box = Image.open(drawing).convert("RGBA").getchannel("A").getbbox()
    return box[3] if box else 0


def looks_of(name: str, drawing: Path, work: Path) -> None:
    """Write a drawing in every look, in the light of three rigs."""
    rows = []
    for rig, paper in RIGS.items():
        lit = [work / rig / look / drawing.name for look in LOOKS]
        for look, path in zip(LOOKS, lit, strict=True):
            light = ("--rig", rig, "--look", look, "--floor", floor_below(drawing))
            lampblack("render", drawing, "-o", path.parent, *light, "--quality", "medium")
        rows.append([opened(path, paper, side=300) for path in lit])
    save(name, rows)


def looks_of_others(work: Path) -> None:
    """The same of drawings that are not ours."""
    for name in OTHERS:
        looks_of(f"looks-{name}.jpg", Path(os.environ["DRAWINGS"]) / f"{name}.png", work / name)


def moving(name: str, work: Path) -> None:
    """An animation as drawn, and in a warm light that moves from left to right."""
    drawn = sorted((Path(os.environ["ANIMATIONS"]) / name).glob("*.png"))
    width, height = Image.open(drawn[0]).size
    unit, last = max(width, height) / 2, len(drawn)
    keys = tuple(
        LightKey(frame, x * width, 0.25 * height, 0.9 * unit, 0.4 * unit, "#ffe3b8", 3.2)
        for frame, x in ((1, -0.1), (last, 1.1))
    )
    first = keys[0]
    warm = AreaLight(first.x, first.y, first.z, first.size, first.colour, first.power, keys=keys)
    cold = AreaLight(0.9 * width, 0.3 * height, -0.4 * unit, 0.5 * unit, "#8db7ff", 1.5)
    floor = Floor(max(floor_below(path) for path in drawn))
    ambient = Ambient("#dfe6ff", 0.35)
    scene = Scene(Canvas(width, height), (warm, cold), ambient=ambient, floor=floor)
    (work / "scene.json").write_bytes(encode_scene(scene))
    light = ("--scene", work / "scene.json", "--quality", "medium")
    lampblack("render", drawn[0].parent, "-o", work / "lit", *light)
    pairs = []
    for path in drawn:
        left, right = (opened(p, side=350) for p in (path, work / "lit" / path.name))
        pair = Image.new("RGB", (2 * left.width, left.height))
        pair.paste(left, (0, 0))
        pair.paste(right, (left.width, 0))
        pairs.append(pair)
    few = [pairs[index * (last - 1) // 4] for index in range(5)]
    palette = Image.fromarray(np.concatenate(few)).quantize(COLOURS, OCTREE)
    first_picture, *rest = (pair.quantize(palette=palette) for pair in pairs)
    with atomic_file(IMAGES / f"{name}.gif") as file:
        first_picture.save(file, "GIF", save_all=True, append_images=rest, duration=83, loop=0)


def animations(work: Path) -> None:
    """Both animations of the gallery."""
    for name in ("kid", "squirrel"):
        (work / name).mkdir()
        moving(name, work / name)


def painted_light(work: Path) -> None:
    """The example as drawn, and at night with strokes on a layer Light."""
    drawing = Image.open(STILL).convert("RGBA")
    light = Image.new("RGBA", drawing.size)
    pen = ImageDraw.Draw(light)
    for colour, width, places in PAINT:
        pen.line(places, colour, width, joint="curve")
        for x, y in (places[0], places[-1]):
            pen.circle((x, y), width / 2, colour)
    stack = "".join(
        f'<layer name="{name}" src="data/{name}.png"/>' for name in ("Light", "Lamplighter")
    )
    width, height = drawing.size
    with zipfile.ZipFile(work / "painted.ora", "w") as archive:
        archive.writestr("mimetype", "image/openraster")
        archive.writestr(
            "stack.xml", f'<image w="{width}" h="{height}"><stack>{stack}</stack></image>'
        )
        for name, picture in (("Light", light), ("Lamplighter", drawing)):
            with archive.open(f"data/{name}.png", "w") as file:
                picture.save(file, "PNG")
    moon = AreaLight(0.1 * width, 0.1 * height, 0.8 * width, 0.3 * width, "#8aa6e8", 1.2)
    scene = Scene(
        Canvas(width, height),
        (moon,),
        ambient=Ambient("#9fb4ff", 0.3),
        painted_light=PaintedLight(power=4.0, height=0.08),
    )
    (work / "scene.json").write_bytes(encode_scene(scene))
    light_up = ("--scene", work / "scene.json", "--quality", "medium")
    lampblack("render", work / "painted.ora", "-o", work / "lit", *light_up)
    (lit,) = (work / "lit").glob("*.png")
    save("painted-light.jpg", [[opened(STILL, side=440), opened(lit, side=440)]])
