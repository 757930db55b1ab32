"""Batches for the character network: whole characters on canvases of one area."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Self

import numpy as np
import torch
from numpy.typing import NDArray
from torch import nn

from lampblack.normals.character import (
    COARSE,
    SIDEWAYS,
    canvas_for,
    coarse_maps,
    ink_cells,
    place,
    shape_maps,
)
from lampblack.normals.precision import fast_arithmetic
from lampblack.normals.resize import resize

from ..dataset.marks import random_marks
from ..dataset.triple import BEHIND, DEPTH_STEPS, IN_FRONT, Triple
from .character_loss import Batch, Loss, character_loss
from .example import Example, make_examples
from .hint_strokes import bent_cells, random_hints
from .stream import Stream
from .stretch import random_stretch, stretched

FULL_BATCH_SIDE, SMALLEST_BATCH = 256, 4
MARKED = 0.35
"""Share of the drawings that get marks which are no edges."""
HINTED = 0.35
"""Share of the examples with hints of an artist."""


@dataclass(frozen=True)
class CanvasCharacter:
    """A triple's character on its canvas.

    Attributes:
        inks: (K, H, W) uint8, its drawings; 255 is full ink.
        marks: (K, h, w) int8: 1 where all ink is of marks, 0 where some is a line, -1 where there
            is none.
        mask: (H, W) bool.
        normals: (H, W, 3) int8, 127 is 1.
        shape: (8, h, w) float16, see ``shape_maps``.
        auxiliary: (3, h, w) float16: depth minus its mean, in canvas sides; near and far sides of
            occlusions, 0 or 1.
        bent: (h, w) int8: 1 where the surface is round, -1 where it is hollow, else 0.
    """

    inks: NDArray[np.uint8]
    marks: NDArray[np.int8]
    mask: NDArray[np.bool_]
    normals: NDArray[np.int8]
    shape: NDArray[np.float16]
    auxiliary: NDArray[np.float16]
    bent: NDArray[np.int8]


def place_on_canvas(
    triple: Triple, rng: np.random.Generator, sides: Sequence[int]
) -> CanvasCharacter:
    """Stretch the triple's character at random, and place it on a canvas of one of ``sides``. Some
    of its drawings get marks that are no edges; its truth stays as it is."""
    side = int(rng.choice(sides))
    box = _box(triple.mask)
    inside = triple.mask[box].astype(np.float32)
    planes = [triple.normals[box].astype(np.float32) / 127.0 * inside[..., None]]
    pixels = np.divide(triple.depth[box], DEPTH_STEPS, dtype=np.float32)
    drawings = np.divide(triple.drawings[:, *box], 255, dtype=np.float32)
    marks = np.stack(
        [
            random_marks(pixels, inside > 0, rng)
            if rng.random() < MARKED
            else np.zeros_like(pixels)
            for _ in drawings
        ]
    )
    planes += [ink.transpose(1, 2, 0) * inside[..., None] for ink in (drawings, marks)]
    depth = pixels / max(inside.shape) * inside
    planes += [depth[..., None], inside[..., None]]
    planes += [(triple.occlusion[box] == near)[..., None] for near in (IN_FRONT, BEHIND)]
    picture = np.concatenate(planes, axis=2, dtype=np.float32)
    # Stretching costs time for every pixel, and a triple has more than the canvas needs.
    smaller = min(1.0, 1.5 * side / inside.size**0.5)
    picture = resize(picture, tuple(max(1, round(n * smaller)) for n in inside.shape))
    picture = stretched(picture, random_stretch(rng))
    picture = picture[_box(picture[..., -3] > 0.5)]
    canvas = canvas_for(picture.shape[:2], side, float(rng.uniform(0.85, 1)))
    placed = place(picture, canvas)
    count = len(triple.drawings)
    normals, inks, marks, rest = np.split(placed, [3, 3 + count, 3 + 2 * count], axis=2)
    share = rest[..., 1:2]
    mask = share[..., 0] > 0.5
    normals /= np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), 1e-6)
    depth = np.divide(rest[..., 0], np.maximum(share[..., 0], 0.25))
    depth = np.where(mask, depth - depth[mask].mean(), 0)
    cells = np.stack([depth, *rest[..., 2:].transpose(2, 0, 1)])
    h, w = (n // COARSE for n in mask.shape)
    cells = cells.reshape(3, h, COARSE, w, COARSE)
    auxiliary = np.concatenate([cells[:1].mean((2, 4)), cells[1:].max(axis=(2, 4)) > 0.25])
    inks, marks = (_unmixed(part, share) * mask for part in (inks, marks))
    kinds = [
        np.where(ink_cells(line), 0, np.where(ink_cells(mark), 1, -1))
        for line, mark in zip(inks, marks, strict=True)
    ]
    return CanvasCharacter(
        np.round(np.maximum(inks, marks) * 255).astype(np.uint8),
        np.stack(kinds).astype(np.int8),
        mask,
        np.round(normals * mask[..., None] * 127).astype(np.int8),
        shape_maps(mask).astype(np.float16),
        auxiliary.astype(np.float16),
        bent_cells(normals, mask),
    )


def _unmixed(ink: NDArray[np.float32], share: NDArray[np.float32]) -> NDArray[np.float32]:
    """(H, W, K) ink that was averaged with what lies outside -> (K, H, W), 0 to 1."""
    return np.clip(np.divide(ink, np.maximum(share, 0.25)), 0, 1).transpose(2, 0, 1)


def _box(mask: NDArray[np.bool_]) -> tuple[slice, slice]:
    rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


class CharacterBatches:
    """Batches of whole characters, all of one canvas shape, half of them mirrored, and their loss.

    A canvas has the area of a square of one of ``sides``. A network trained on several sides sees
    a character both as a whole and in its parts. Use as a context manager.
    """

    def __init__(self, data: Path, sides: Sequence[int], seed: int, capacity: int = 2000) -> None:
        self._rng = np.random.default_rng(seed)
        prepare = partial(place_on_canvas, sides=sides)
        self._stream = Stream(data, prepare, _canvas_shape, seed=seed, capacity=capacity)

    def __enter__(self) -> Self:
        self._stream.__enter__()
        return self

    def __exit__(self, *left: object) -> None:
        self._stream.__exit__(None, None, None)

    def loss(self, network: nn.Module, size: int) -> Loss:
        """The loss of ``network`` on the next ``size`` characters."""
        batch = self._batch(size)
        with fast_arithmetic():
            found = network(batch.fine, batch.coarse)
        return character_loss(found, batch)

    def examples(self, network: nn.Module, size: int) -> list[Example]:
        """Predictions of ``network``, in evaluation mode, for ``size`` characters."""
        batch = self._batch(size)
        with torch.inference_mode(), fast_arithmetic():
            vectors, _, _ = network(batch.fine, batch.coarse)
        return make_examples(batch.fine[:, 0], batch.fine[:, 1], batch.normals, vectors)

    def _batch(self, size: int) -> Batch:
        characters = self._stream.take(size, self._rng)
        rows, columns = characters[0].mask.shape
        # Time grows with the area of the canvas: a batch of large ones is smaller.
        fewer = max(SMALLEST_BATCH, round(size * FULL_BATCH_SIDE**2 / (rows * columns)))
        return _stack([input_and_truth(each, self._rng) for each in characters[:fewer]])


def _canvas_shape(character: CanvasCharacter) -> tuple[int, ...]:
    return character.mask.shape


def _stack(samples: list[tuple[NDArray[np.float32], ...]]) -> Batch:
    """A batch of results of ``input_and_truth``."""
    fine, coarse, normals, auxiliary = (
        torch.from_numpy(np.stack(part)) for part in zip(*samples, strict=True)
    )
    last = torch.channels_last
    return Batch(
        fine.contiguous(memory_format=last),
        coarse.contiguous(memory_format=last),
        normals,
        auxiliary,
    )


def input_and_truth(
    character: CanvasCharacter, rng: np.random.Generator
) -> tuple[NDArray[np.float32], ...]:
    """Input and truth of one of the drawings, see ``Batch``; mirrored half the time."""
    chosen = rng.integers(len(character.inks))
    ink = character.inks[chosen] / np.float32(255)
    fine = np.stack([ink, character.mask.astype(np.float32)])
    hints = random_hints(character.bent, rng) if rng.random() < HINTED else None
    coarse = coarse_maps(character.shape.astype(np.float32), ink, hints)
    normals = character.normals.transpose(2, 0, 1) / np.float32(127)
    auxiliary = np.concatenate([character.auxiliary, character.marks[chosen, None]])
    auxiliary = auxiliary.astype(np.float32)
    parts = [fine, coarse, normals, auxiliary]
    if rng.random() < 0.5:
        parts = [part[..., ::-1].copy() for part in parts]
        parts[1][list(SIDEWAYS)] *= -1
        parts[2][0] *= -1
    return tuple(parts)
