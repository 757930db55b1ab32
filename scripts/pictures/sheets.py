"""What all recipes use: commands, pictures on paper, and tables of pictures."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from PIL import Image

from lampblack.atomic import atomic_file

ROOT = Path(__file__).parents[2]
IMAGES = ROOT / "docs" / "images"
STILL, SCENE = ROOT / "examples" / "character.png", ROOT / "examples" / "character.scene.json"


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


def in_a_square(picture: Image.Image, side: int = 134) -> Image.Image:
    """A picture in the middle of a white square."""
    square = Image.new("RGB", (side, side), "#ffffff")
    square.paste(picture, ((side - picture.width) // 2, (side - picture.height) // 2))
    return square
