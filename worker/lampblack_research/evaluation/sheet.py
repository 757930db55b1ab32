"""A contact sheet of drawings, their true normals, and those of every method."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from .drawings import TestDrawing

CELL = 160
LABEL = 14
MOST_ROWS = 24


class ComparisonSheet:
    """One row a model, its first drawing; columns are the drawing, the truth and the methods."""

    def __init__(self) -> None:
        self._rows: list[list[NDArray[np.uint8]]] = []
        self._names: list[str] = []
        self._models: set[str] = set()

    def add(self, drawing: TestDrawing, normals: dict[str, NDArray[np.float32]]) -> None:
        """Add a drawing, unless its model has one already or the sheet is full."""
        if drawing.model in self._models or len(self._rows) == MOST_ROWS:
            return
        self._models.add(drawing.model)
        self._names = ["drawing", "truth", *normals]
        paper = np.where(drawing.mask, 255 * (1 - drawing.lines), 200)
        cells = [np.repeat(paper[..., None], 3, axis=2)]
        for found in (drawing.truth, *normals.values()):
            cells.append(np.where(drawing.mask[..., None], (found + 1) * 127.5, 255))
        self._rows.append([_fit(cell.astype(np.uint8)) for cell in cells])

    def picture(self) -> NDArray[np.uint8]:
        """(H, W, 3) uint8."""
        body = np.vstack([np.hstack(row) for row in self._rows])
        head = Image.new("RGB", (body.shape[1], LABEL), "white")
        pen = ImageDraw.Draw(head)
        for index, name in enumerate(self._names):
            pen.text((index * CELL + 4, 1), name, fill="black")
        return np.vstack([np.asarray(head), body])


def _fit(cell: NDArray[np.uint8]) -> NDArray[np.uint8]:
    image = Image.fromarray(cell)
    image.thumbnail((CELL - 4, CELL - 4), Image.Resampling.LANCZOS)
    square = Image.new("RGB", (CELL, CELL), "white")
    square.paste(image, ((CELL - image.width) // 2, (CELL - image.height) // 2))
    return np.asarray(square)
