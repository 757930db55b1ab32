"""Pictures of surfaces: corrections, normals, data sets and tests."""

from __future__ import annotations

import json
import math
import os
from pathlib import Path

import numpy as np
from PIL import Image
from sheets import STILL, in_a_square, lampblack, opened, save

from lampblack.surface import normals_of
from lampblack_research.dataset.triple import Triple, entry_paths

LIGHT = np.array([-0.55, 0.6, 0.58])
"""From where the clay is lit: x right, y up, z to the viewer."""
CREATURES, PER_ROW, CELL = 14, 7, 148
"""The last is in pixels."""


def ring(x: float, y: float, radius: float) -> list[dict[str, float]]:
    """Points once around a place of the drawing."""
    turns = [2 * math.pi * step / 20 for step in range(21)]
    return [{"x": x + radius * math.cos(t), "y": y + 1.15 * radius * math.sin(t)} for t in turns]


def brush(
    kind: str, points: list[dict[str, float]], radius: float, amount: float
) -> dict[str, object]:
    """A stroke that corrects the surface of the example."""
    return {"frame": 1, "points": points, "brush": kind, "radius": radius, "amount": amount}


CORRECTIONS = (
    {},
    {
        "colours": [
            {"colour": "#12111a", "volume": 3.0},
            {"colour": "#f6e5c0", "volume": 1.8},
            {"colour": "#dd3f2e", "volume": 0.0},
            {"colour": "#9c2532", "volume": 0.0},
        ]
    },
    {
        "strokes": [
            *(brush("dent", ring(x, 267, 66), 34, 0.45) for x in (433, 612)),
            *(brush("bump", [{"x": x, "y": 343}], 44, 0.5) for x in (368, 676)),
        ]
    },
)
"""The field ``depth`` of three scenes of the example."""


def corrections(work: Path) -> None:
    """The example as clay: as found, with volumes of colours, and with strokes of brushes."""
    clays = []
    for number, depth in enumerate(CORRECTIONS):
        said, height = work / f"{number}.json", work / f"{number}.npy"
        said.write_text(json.dumps(depth))
        lampblack("depth", STILL, "-o", height, "--depth-hints", said)
        clays.append(clay(np.load(height)))
    save("corrections.jpg", [clays])


def clay(height: np.ndarray) -> Image.Image:
    """A height, (H, W) and NaN outside, as clay in a light from the upper left."""
    mask = np.isfinite(height)
    normals = normals_of(np.where(mask, height, 0).astype(np.float32), mask)
    grey = np.where(mask, 35 + 200 * np.clip(normals @ LIGHT, 0, 1), 255)
    picture = Image.fromarray(grey.astype(np.uint8)).crop(Image.fromarray(mask).getbbox())
    picture.thumbnail((470, 470), Image.Resampling.LANCZOS)
    return picture.convert("RGB")


def random_creatures(work: Path) -> None:
    """A drawing of each, and its normals."""
    words = ("--creatures", CREATURES, "--resolution", 256, "--freestyle", 0, "--hands", 1)
    lampblack("dataset", "build", "-o", work, *words)
    rows: list[list[Image.Image]] = []
    for number, path in enumerate(entry_paths(work)):
        entry = Triple.load(path)
        normals = np.where(entry.mask[..., None], entry.normals.astype(np.int16) + 127, 255)
        if number % PER_ROW == 0:
            rows += [[], []]
        for row, cell in zip(rows[-2:], (255 - entry.drawings[0], normals), strict=True):
            picture = Image.fromarray(cell.astype(np.uint8)).convert("RGB")
            picture.thumbnail((CELL, CELL), Image.Resampling.LANCZOS)
            row.append(in_a_square(picture, CELL + 4))
    save("creatures.jpg", rows)


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
