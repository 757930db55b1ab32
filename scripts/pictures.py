"""Make the pictures of the documentation anew: the one place that says how each is made.

    python scripts/pictures.py                    # all whose command is known (make pictures)
    python scripts/pictures.py depth.jpg          # only this one, and those that come with it
    python scripts/pictures.py --list             # how each picture is made

Some need what is not part of the repository: DRAWINGS names a folder with kid.png, dino.png,
cat.png and others (see docs/licences.md), ANIMATIONS one with the folders kid and squirrel, MODELS
one with meshes (see docs/research/dataset.md).
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from PIL import Image

from lampblack.atomic import atomic_file
from lampblack.scene import Ambient, AreaLight, Canvas, Floor, LightKey, Scene, encode_scene

ROOT = Path(__file__).parents[1]
IMAGES = ROOT / "docs" / "images"
STILL, SCENE = ROOT / "examples" / "character.png", ROOT / "examples" / "character.scene.json"
LOOKS = ("smooth", "soft-cel", "hard-cel", "two-tone-rim")
RIGS = {"key": "#f4efe6", "sunset": "#f4cba7", "moon": "#3f4a80"}
"""Each rig with the paper that its pictures lie on."""
OTHERS = ("kid", "dino", "cat")
COLOURS = 128
"""Of a moving picture."""


def lampblack(*words: object) -> None:
    """Run a command of ``lampblack``."""
    run(sys.executable, "-m", "lampblack", *words)


def run(*words: object) -> None:
    """Run a program in the root of the checkout; if it fails, so do we."""
    subprocess.run([str(word) for word in words], cwd=ROOT, check=True)


def opened(path: Path, paper: str = "#ffffff", side: int = 600) -> Image.Image:
    """A picture on ``paper``, its longer side ``side`` pixels."""
    picture = Image.open(path).convert("RGBA")
    ground = Image.new("RGBA", picture.size, paper)
    ground.alpha_composite(picture)
    ground.thumbnail((side, side), Image.Resampling.LANCZOS)
    return ground.convert("RGB")


def save(name: str, rows: Sequence[Sequence[Image.Image]]) -> None:
    """Write pictures of one size as a table."""
    width, height = rows[0][0].size
    table = Image.new("RGB", (width * len(rows[0]), height * len(rows)))
    for y, row in enumerate(rows):
        for x, picture in enumerate(row):
            table.paste(picture, (x * width, y * height))
    with atomic_file(IMAGES / name) as file:
        table.save(file, "PNG" if name.endswith(".png") else "JPEG", quality=88, optimize=True)


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
    palette = pairs[0].quantize(COLOURS)
    first_picture, *rest = (pair.quantize(palette=palette) for pair in pairs)
    with atomic_file(IMAGES / f"{name}.gif") as file:
        first_picture.save(file, "GIF", save_all=True, append_images=rest, duration=83, loop=0)


def animations(work: Path) -> None:
    """Both animations of the gallery."""
    for name in ("kid", "squirrel"):
        (work / name).mkdir()
        moving(name, work / name)


def normals_of_drawings(work: Path) -> None:
    """Every drawing with its normals, and in two lights; two drawings in a row."""
    cells = []
    for drawing in sorted(Path(os.environ["DRAWINGS"]).glob("*.png")):
        normals = work / f"{drawing.stem}.normals.png"
        lampblack("normals", drawing, "-o", normals)
        made = [drawing, normals]
        for rig in ("key", "under-light"):
            lampblack("render", drawing, "-o", work / rig, "--rig", rig, "--quality", "low")
            made.append(work / rig / drawing.name)
        cells.append([in_a_square(opened(path, side=130)) for path in made])
    blank = [in_a_square(Image.new("RGB", (1, 1), "#ffffff"))] * 4
    cells += [blank] * (len(cells) % 2)
    save("normals-drawings.jpg", [a + b for a, b in zip(cells[::2], cells[1::2], strict=True)])


def in_a_square(picture: Image.Image) -> Image.Image:
    """A picture in the middle of a white square."""
    side = 134
    square = Image.new("RGB", (side, side), "#ffffff")
    square.paste(picture, ((side - picture.width) // 2, (side - picture.height) // 2))
    return square


def sheet_of_normals(work: Path) -> None:
    """One side of each test model."""
    words = ("--models", os.environ["MODELS"], "--split", "test", "--sheet", work / "sheet.png")
    lampblack("evaluate", *words, "--methods", "lampblack,paper,lumo,inflate,laigter-tuned")
    save("normals-test.jpg", [[opened(work / "sheet.png", side=1054)]])


def sheet_of_the_data_set(work: Path) -> None:
    """Some entries of a small data set."""
    words = ("--models", os.environ["MODELS"], "-o", work / "dataset", "--split", "val")
    lampblack("dataset", "build", *words, "--views", 2)
    save("dataset.jpg", [[opened(work / "dataset" / "sheet.png", side=910)]])


def window(work: Path) -> None:
    """The example in ``lampblack-window``."""
    test = "tests/window/test_own_window.py::test_a_project_of_pencil2d_needs_no_pencil2d"
    run(sys.executable, "-m", "pytest", "-q", test)
    with Image.open(ROOT / "build" / "screenshots" / "own window project.png") as screen:
        screen.crop((0, 0, *WINDOW_SIZE)).save(work / "window.png")
    save("window.jpg", [[opened(work / "window.png", side=1000)]])


@dataclass(frozen=True)
class Recipe:
    """How pictures are made that come together."""

    names: tuple[str, ...]
    make: Callable[[Path], None]
    how: str
    needs: str = ""
    """A variable of the environment."""


WINDOW = ("lit", "menu", "floor", "glossy", "normals", "keys", "depth")
RECORDED = ("pencil2d-drawing.gif", "pencil2d-drag.gif")
WINDOW_SIZE = (1434, 990)
"""Of the window with its frame on a screenshot, pixels."""
RECIPES = (
    Recipe(
        ("architecture.svg",),
        lambda _: run(sys.executable, "tests/architecture.py", IMAGES / "architecture.svg"),
        "tests/architecture.py, also by make schema",
    ),
    Recipe(
        ("lamplighter.png", "before-after-cel.jpg", "depth.jpg"),
        stills,
        "lampblack render and depth, of examples/character.png",
    ),
    Recipe(
        ("looks-bear.jpg",),
        lambda work: looks_of("looks-bear.jpg", STILL, work),
        "lampblack render, 12 times",
    ),
    Recipe(
        tuple(f"looks-{name}.jpg" for name in OTHERS),
        looks_of_others,
        "lampblack render, 12 times, of a drawing in DRAWINGS",
        "DRAWINGS",
    ),
    Recipe(
        (*(f"pencil2d-{name}.png" for name in WINDOW), *RECORDED),
        lambda _: run(sys.executable, "tests/record_window.py", IMAGES),
        "tests/record_window.py, in the real Pencil2D",
    ),
    Recipe(("window.jpg",), window, "a test of lampblack-window, in a virtual display"),
    Recipe(
        ("dragged-light.gif",),
        lambda _: run(sys.executable, "examples/drag_light.py", IMAGES / "dragged-light.gif"),
        "examples/drag_light.py",
    ),
    Recipe(
        ("kid.gif", "squirrel.gif"),
        animations,
        "lampblack render, of an animation in ANIMATIONS",
        "ANIMATIONS",
    ),
    Recipe(
        ("normals-drawings.jpg",),
        normals_of_drawings,
        "lampblack normals and render, of the drawings in DRAWINGS",
        "DRAWINGS",
    ),
    Recipe(
        ("normals-test.jpg",), sheet_of_normals, "lampblack evaluate --sheet, of MODELS", "MODELS"
    ),
    Recipe(("dataset.jpg",), sheet_of_the_data_set, "lampblack dataset build, of MODELS", "MODELS"),
)
BY_HAND = {
    "corrections.jpg": "corrections in the view Depth; the values were not kept",
    "creatures.jpg": "random creatures of a data set; the seed was not kept",
    "painted-light.png": "strokes on a layer Light; the strokes were not kept",
    "pencil2d-panel.png": "a screenshot of a screen of 1366 x 768, taken by hand",
}
"""Pictures that no command makes yet."""


def main(wanted: Sequence[str]) -> int:
    """Make the pictures ``wanted``, or all whose command is known."""
    if [*wanted] == ["--list"]:
        told = {name: recipe.how for recipe in RECIPES for name in recipe.names}
        told |= {name: f"no command: {how}" for name, how in BY_HAND.items()}
        sys.stdout.writelines(f"{name:24} {how}\n" for name, how in sorted(told.items()))
        return 0
    known = {name for recipe in RECIPES for name in recipe.names}
    unknown = {*wanted} - known
    if unknown:
        sys.stderr.write(f"error: No command makes {', '.join(sorted(unknown))}. See --list.\n")
        return 2
    for recipe in RECIPES:
        names = ", ".join(recipe.names)
        if wanted and not {*wanted} & {*recipe.names}:
            continue
        if recipe.needs and recipe.needs not in os.environ:
            sys.stderr.write(f"left out, because {recipe.needs} is not set: {names}\n")
        else:
            sys.stderr.write(f"{names}\n")
            with tempfile.TemporaryDirectory() as work:
                recipe.make(Path(work))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
