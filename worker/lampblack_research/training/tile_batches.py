"""Batches for the paper's networks: tiles of 256 x 256 at three scales."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Self

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from lampblack.normals.precision import fast_arithmetic
from lampblack.normals.tiles import ALIGNMENT, TILE, TileSource

from ..dataset.triple import Triple
from .character_loss import Loss, angles
from .example import Example, make_examples
from .stream import Stream

Tile = tuple[NDArray[np.float32], NDArray[np.float32]]


@dataclass(frozen=True)
class View:
    """One drawing of a triple: lines (H, W) uint8, 255 is full ink; mask (H, W)
    bool; normals (H, W, 3) int8, 127 is 1."""

    lines: NDArray[np.uint8]
    mask: NDArray[np.bool_]
    normals: NDArray[np.int8]

    def tile(self, rng: np.random.Generator) -> Tile:
        """A random tile near a pixel of the character, mirrored half the time.

        Returns:
            (4, 256, 256) float32 input and (3, 256, 256) float32 truth.
        """
        rows, columns = np.nonzero(self.mask)
        pick = rng.integers(len(rows))
        jitter = rng.integers(-96, 96, 2)
        row = int(rows[pick] - TILE // 2 + jitter[0]) // ALIGNMENT * ALIGNMENT
        column = int(columns[pick] - TILE // 2 + jitter[1]) // ALIGNMENT * ALIGNMENT
        height, width = self.mask.shape
        top, left = max(row, 0), max(column, 0)
        bottom, right = min(row + TILE, height), min(column + TILE, width)
        truth = np.zeros((3, TILE, TILE), np.float32)
        truth[:, top - row : bottom - row, left - column : right - column] = self.normals[
            top:bottom, left:right
        ].transpose(2, 0, 1) / np.float32(127)
        tile = TileSource(self.lines.astype(np.float32) / 255.0, self.mask).cut(row, column)
        if rng.random() < 0.5:
            tile, truth = tile[:, :, ::-1].copy(), truth[:, :, ::-1].copy()
            truth[0] *= -1
        return tile, truth


def view_of(triple: Triple, rng: np.random.Generator) -> View:
    """A random drawing of a triple."""
    return View(triple.drawings[rng.integers(len(triple.drawings))], triple.mask, triple.normals)


class TileBatches:
    """Batches of tiles, and their loss. Use as a context manager."""

    def __init__(self, data: Path, seed: int, capacity: int = 2000) -> None:
        self._rng = np.random.default_rng(seed)
        self._stream = Stream(data, view_of, _one_kind, seed=seed, capacity=capacity)

    def __enter__(self) -> Self:
        self._stream.__enter__()
        return self

    def __exit__(self, *left: object) -> None:
        self._stream.__exit__(None, None, None)

    def loss(self, network: nn.Module, size: int) -> Loss:
        """The loss of ``network`` on the next ``size`` tiles."""
        tiles, truth = self._batch(size)
        mask = tiles[:, 3:4]
        with fast_arithmetic():
            predicted = network(tiles)
        with torch.no_grad():
            unit = nn.functional.normalize(predicted.float(), dim=1)
            angle = (angles(unit, truth) * mask[:, 0]).sum() / mask.sum().clamp(min=1)
        return Loss(normal_loss(predicted, truth, mask), math.degrees(float(angle)))

    def examples(self, network: nn.Module, size: int) -> list[Example]:
        """Predictions of ``network``, in evaluation mode, for ``size`` tiles."""
        tiles, truth = self._batch(size)
        with torch.inference_mode(), fast_arithmetic():
            predicted = network(tiles)
        return make_examples(tiles[:, 0], tiles[:, 3], truth, predicted)

    def _batch(self, size: int) -> tuple[Tensor, Tensor]:
        cut = [view.tile(self._rng) for view in self._stream.take(size, self._rng)]
        tiles = torch.from_numpy(np.stack([tile for tile, _ in cut]))
        truth = torch.from_numpy(np.stack([normals for _, normals in cut]))
        return tiles.contiguous(memory_format=torch.channels_last), truth


def _one_kind(view: View) -> None:
    """Tiles of all views may share a batch."""


def normal_loss(predicted: Tensor, truth: Tensor, mask: Tensor) -> Tensor:
    """Equation 2: half the squared difference, averaged over the foreground.

    Args:
        predicted, truth: (B, 3, H, W); ``truth`` is unit in the mask. mask: (B, 1, H, W).
    """
    error = 0.5 * (predicted.float() - truth).square().sum(dim=1, keepdim=True)
    return (error * mask).sum() / mask.sum().clamp(min=1)
