"""Normals, depth and occlusions of a whole character at once, by the character network."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import torch
from numpy.typing import NDArray
from torch import nn

from .character import (
    COARSE,
    SIDEWAYS,
    Canvas,
    canvas_for,
    coarse_maps,
    extend_outside,
    place,
    resize,
    shape_maps,
)
from .precision import fast_arithmetic


def mean_planes(
    network: nn.Module,
    sides: Sequence[int],
    lines: NDArray[np.float32],
    mask: NDArray[np.bool_],
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """The mean prediction over canvases of several ``sides``, the largest last.

    On a small canvas the network sees the whole, on a large one the parts, and its errors
    differ. Arguments and result as in ``character_planes``, at the largest size.
    """
    *smaller, largest = sides
    planes, seen = character_planes(network, largest, lines, mask)
    for side in smaller:
        rough = extend_outside(*character_planes(network, side, lines, mask))
        planes += resize(rough, seen.shape)
    return planes / len(sides), seen


def character_planes(
    network: nn.Module,
    side: int,
    lines: NDArray[np.float32],
    mask: NDArray[np.bool_],
    *,
    mirrored: bool = True,
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """The prediction for one character, at the resolution of its canvas.

    Args:
        network: a ``CharacterNet`` in evaluation mode.
        side: size of the canvas, as the side in pixels of a square of equal area.
        lines: (H, W) float32 ink in 0..1. mask: (H, W) bool. Both cropped to the character.
        mirrored: average with the prediction for the mirror image, so that a mirrored
            character gets exactly mirrored normals; this doubles the cost.

    Returns:
        (h, w, 5) float32: the normal, roughly unit; the depth towards the viewer, in longer
        sides of the box; how likely the pixel lies at an occlusion, 0 to 1. And the (h, w) bool
        mask at that size.
    """
    rows, columns = mask.shape
    canvas = canvas_for((rows, columns), side)
    fine, coarse, small = character_input(lines, mask, canvas)
    if mirrored:
        flipped = coarse.flip(-1)
        flipped[:, list(SIDEWAYS)] *= -1
        fine, coarse = torch.cat([fine, fine.flip(-1)]), torch.cat([coarse, flipped])
    last = torch.channels_last
    with torch.inference_mode(), fast_arithmetic():
        vectors, _, auxiliary = network(
            fine.contiguous(memory_format=last), coarse.contiguous(memory_format=last)
        )
    vectors = nn.functional.normalize(vectors, dim=1)
    edge = auxiliary[:, 1:].amax(dim=1, keepdim=True).sigmoid()
    cells = torch.cat([auxiliary[:, :1], edge], dim=1)
    if mirrored:
        back = vectors[1].flip(-1)
        back[0] *= -1
        vectors = (vectors[:1] + back) / 2
        cells = (cells[:1] + cells[1:].flip(-1)) / 2
    planes = np.concatenate([_channels_last(vectors), _spread(_channels_last(cells), small)], 2)
    return planes[canvas.inner], small[canvas.inner]


def _channels_last(batch: torch.Tensor) -> NDArray[np.float32]:
    planes: NDArray[np.float32] = batch[0].permute(1, 2, 0).contiguous().numpy()
    return planes


def _spread(cells: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """(h, w, C) cells -> (H, W, C), the size of ``mask``. Cells outside are not trained, so none of
    them are mixed in."""
    touched = mask.reshape(cells.shape[0], COARSE, cells.shape[1], COARSE).any(axis=(1, 3))
    return resize(extend_outside(cells, touched), mask.shape)


def character_input(
    lines: NDArray[np.float32], mask: NDArray[np.bool_], canvas: Canvas
) -> tuple[torch.Tensor, torch.Tensor, NDArray[np.bool_]]:
    """The fine (1, 2, h, w) and coarse (1, 10, h/4, w/4) input tensors, and the (h, w) mask."""
    placed = place(np.stack([lines * mask, mask], axis=2).astype(np.float32), canvas)
    share = placed[..., 1]
    small = share > 0.5
    if not small.any():
        small = share >= share.max()
    ink = np.clip(placed[..., 0] / np.maximum(share, 0.25), 0, 1) * small
    fine = torch.from_numpy(np.stack([ink, small.astype(np.float32)]))[None]
    return fine, torch.from_numpy(coarse_maps(shape_maps(small), ink))[None], small
