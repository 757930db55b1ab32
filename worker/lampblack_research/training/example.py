"""Pictures of predictions during training."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from torch import Tensor, nn

from lampblack.atomic import atomic_file

_GAP = 4


@dataclass(frozen=True)
class Example:
    """``lines`` (H, W) float32 ink in 0..1; ``mask`` (H, W) bool; ``truth`` and ``found``
    (H, W, 3) float32, unit in the mask."""

    lines: NDArray[np.float32]
    mask: NDArray[np.bool_]
    truth: NDArray[np.float32]
    found: NDArray[np.float32]


def make_examples(lines: Tensor, mask: Tensor, truth: Tensor, vectors: Tensor) -> list[Example]:
    """Split a batch: (B, H, W) lines and masks, (B, 3, H, W) normals; ``vectors`` of any length."""
    unit = nn.functional.normalize(vectors.float(), dim=1)
    return [
        Example(a.numpy(), b.numpy() > 0.5, c.permute(1, 2, 0).numpy(), d.permute(1, 2, 0).numpy())
        for a, b, c, d in zip(lines, mask, truth, unit, strict=True)
    ]


def save_examples(path: Path, examples: list[Example]) -> None:
    """Write a PNG of three rows: drawings, true normals, predicted normals."""
    columns = []
    for example in examples:
        inside = example.mask[..., None]
        ink = 255 * (1 - np.clip(example.lines, 0, 1))[..., None].repeat(3, axis=2)
        cells = [np.where(inside, ink, 200)]
        cells += [np.where(inside, (n + 1) * 127.5, 255) for n in (example.truth, example.found)]
        columns.append(np.vstack([_framed(cell) for cell in cells]))
    with atomic_file(path) as file:
        Image.fromarray(np.hstack(columns).astype(np.uint8)).save(file, "PNG")


def _framed(cell: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.pad(cell, ((0, _GAP), (0, _GAP), (0, 0)), constant_values=255)
