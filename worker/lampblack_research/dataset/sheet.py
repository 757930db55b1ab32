"""A contact sheet of a data set: drawings, depth, occlusions and normals of some entries."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from lampblack.errors import LampblackError

from .triple import BEHIND, IN_FRONT, Triple, entry_paths

CELL = 160
ROWS = 16


def dataset_sheet(folder: Path) -> Image.Image:
    """``ROWS`` entries spread over the data set in ``folder``, one a row.

    Raises:
        LampblackError: the data set is empty.
    """
    paths = entry_paths(folder)
    if not paths:
        raise LampblackError(f"{folder} holds no data set.", "Check that the models can be read.")
    chosen = paths[:: max(1, len(paths) // ROWS)][:ROWS]
    rows = [np.hstack([_fit(cell) for cell in _cells(Triple.load(path))]) for path in chosen]
    width = max(row.shape[1] for row in rows)
    padded = [
        np.pad(row, [(0, 0), (0, width - row.shape[1]), (0, 0)], constant_values=255)
        for row in rows
    ]
    return Image.fromarray(np.vstack(padded))


def _cells(triple: Triple) -> list[NDArray[np.uint8]]:
    mask = triple.mask[..., None]
    grey = [255 - drawing for drawing in triple.drawings]
    depth = triple.depth / max(1, int(triple.depth.max())) * 255
    grey.append(np.where(triple.mask, depth, 255).astype(np.uint8))
    edges = np.where(mask, 215, 255).astype(np.uint8).repeat(3, axis=2)
    edges[triple.occlusion == IN_FRONT] = (200, 30, 30)
    edges[triple.occlusion == BEHIND] = (30, 60, 200)
    normals = np.where(mask, triple.normals.astype(np.int16) + 127, 255).astype(np.uint8)
    return [*(g[..., None].repeat(3, axis=2) for g in grey), edges, normals]


def _fit(cell: NDArray[np.uint8]) -> NDArray[np.uint8]:
    image = Image.fromarray(cell)
    image.thumbnail((CELL - 4, CELL - 4), Image.Resampling.LANCZOS)
    square = Image.new("RGB", (CELL, CELL), "white")
    square.paste(image, ((CELL - image.width) // 2, (CELL - image.height) // 2))
    return np.asarray(square)
