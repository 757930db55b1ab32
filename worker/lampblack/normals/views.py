"""Training views: a random model from a random side, drawn by a random hand."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import LampblackError
from .gbuffer import trace, view_rotation
from .linework import Hand, draw_lines
from .models import load_model
from .tiles import ALIGNMENT, TILE, TileSource

MAX_BARREN = 100


@dataclass(frozen=True)
class View:
    """A drawing and its truth, 8 bits a value to hold many: lines (H, W) uint8, 255 is full
    ink; mask (H, W) bool; normals (H, W, 3) int8, 127 is 1."""

    lines: NDArray[np.uint8]
    mask: NDArray[np.bool_]
    normals: NDArray[np.int8]

    def tile(self, rng: np.random.Generator) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        """A random tile about a figure pixel, mirrored half of the time.

        Returns:
            (4, 256, 256) float32 input and (3, 256, 256) float32 truth.
        """
        rows, columns = np.nonzero(self.mask[::4, ::4])
        if not len(rows):
            rows, columns = np.nonzero(self.mask)[0] // 4, np.nonzero(self.mask)[1] // 4
        pick = rng.integers(len(rows))
        jitter = rng.integers(-96, 96, 2)
        row = int(rows[pick] * 4 - TILE // 2 + jitter[0]) // ALIGNMENT * ALIGNMENT
        column = int(columns[pick] * 4 - TILE // 2 + jitter[1]) // ALIGNMENT * ALIGNMENT
        height, width = self.mask.shape
        top, left = max(row, 0), max(column, 0)
        bottom, right = min(row + TILE, height), min(column + TILE, width)
        truth = np.zeros((3, TILE, TILE), np.float32)
        truth[:, top - row : bottom - row, left - column : right - column] = self.normals[
            top:bottom, left:right
        ].transpose(2, 0, 1) / np.float32(127)
        tile = TileSource(self.lines / np.float32(255), self.mask).cut(row, column)
        if rng.random() < 0.5:
            tile, truth = tile[:, :, ::-1].copy(), truth[:, :, ::-1].copy()
            truth[0] *= -1
        return tile, truth


def random_views(models: list[Path], seed: int, figure_px: tuple[int, int]) -> Iterator[View]:
    """Views without end. Sources are drawn by the square root of their size, so that the many
    soldiers of one game do not drown the few cartoon figures of another.

    Raises:
        LampblackError: one model after the other gives no view.
    """
    rng = np.random.default_rng(seed)
    sources: dict[str, list[Path]] = defaultdict(list)
    for path in models:
        sources[path.parent.name].append(path)
    names = sorted(sources)
    shares = np.sqrt([len(sources[name]) for name in names])
    barren = 0
    while True:
        if barren == MAX_BARREN:
            raise LampblackError(
                f"{MAX_BARREN} models in a row gave nothing to draw.", "Check the models."
            )
        barren += 1
        name = names[rng.choice(len(names), p=shares / shares.sum())]
        path = sources[name][rng.integers(len(sources[name]))]
        try:
            model = load_model(path)
        except LampblackError:
            continue
        size = int(np.exp(rng.uniform(*np.log(figure_px))))
        azimuth = float(rng.choice([rng.normal(0, 50), rng.uniform(-180, 180)]))
        elevation = float(np.clip(rng.normal(10, 14), -25, 60))
        view = trace(model, view_rotation(azimuth, elevation, float(rng.normal(0, 6))), size)
        if view.mask.sum() < 0.02 * size * size:
            continue
        barren = 0
        lines = draw_lines(view, Hand.random(rng, size), rng)
        yield View(
            lines=np.round(lines * 255).astype(np.uint8),
            mask=view.mask,
            normals=np.round(view.normals * 127).astype(np.int8),
        )
