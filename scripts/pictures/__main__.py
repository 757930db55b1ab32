"""Make the pictures of the documentation anew: the one place that says how each is made.

    python scripts/pictures                    # all (make pictures)
    python scripts/pictures depth.jpg          # only this one, and those that come with it
    python scripts/pictures --list             # how each picture is made

Some need what is not part of the repository: DRAWINGS names a folder with kid.png, dino.png,
cat.png and others (see docs/licences.md), ANIMATIONS one with the folders kid and squirrel, MODELS
one with meshes (see docs/research/dataset.md).
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from light import OTHERS, animations, looks_of, looks_of_others, painted_light, stills
from PIL import Image
from sheets import IMAGES, ROOT, STILL, opened, run, save
from surface import (
    corrections,
    normals_of_drawings,
    random_creatures,
    sheet_of_normals,
    sheet_of_the_data_set,
)


def in_pencil2d(part: str, _: Path) -> None:
    """A part of the pictures of the real Pencil2D."""
    run(sys.executable, "tests/record_window.py", IMAGES, part)


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


IN_PENCIL2D = {
    "drawing": ("drawing.gif",),
    "floor": ("lit.png", "menu.png", "floor.png", "glossy.png", "normals.png"),
    "keys": ("keys.png",),
    "depth": ("depth.png",),
    "drag": ("drag.gif",),
    "panel": ("panel.png",),
}
"""Each part of ``tests/record_window.py``, and what it makes."""
WINDOW_SIZE = (1434, 990)
"""Of the window with its frame on a screenshot, pixels."""
FIGURES = ROOT / "docs" / "data" / "scale.json"
RECIPES = (
    Recipe(
        ("architecture.svg",),
        lambda _: run(sys.executable, "tests/architecture.py", IMAGES / "architecture.svg"),
        "tests/architecture.py, also by make schema",
    ),
    Recipe(
        ("scale.svg",),
        lambda _: run(sys.executable, "scripts/plot_scale.py", FIGURES, IMAGES / "scale.svg"),
        "scripts/plot_scale.py, of lampblack bench scale --json > docs/data/scale.json",
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
    Recipe(("painted-light.jpg",), painted_light, "lampblack render, of a file with a layer Light"),
    Recipe(("corrections.jpg",), corrections, "lampblack depth --depth-hints"),
    Recipe(("creatures.jpg",), random_creatures, "lampblack dataset build --creatures"),
    Recipe(
        tuple(f"looks-{name}.jpg" for name in OTHERS),
        looks_of_others,
        "lampblack render, 12 times, of a drawing in DRAWINGS",
        "DRAWINGS",
    ),
    *(
        Recipe(
            tuple(f"pencil2d-{name}" for name in names),
            partial(in_pencil2d, part),
            f"tests/record_window.py {part}, in the real Pencil2D",
        )
        for part, names in IN_PENCIL2D.items()
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


def main(wanted: Sequence[str]) -> int:
    """Make the pictures ``wanted``, or all of them."""
    if [*wanted] == ["--list"]:
        told = {name: recipe.how for recipe in RECIPES for name in recipe.names}
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
