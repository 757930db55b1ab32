"""Normals, depth and occlusions of a whole character at once, by the character network."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.special import expit

from .bend_strokes import BendStroke, stroke_cells
from .character import (
    COARSE,
    SIDEWAYS,
    Canvas,
    canvas_for,
    coarse_maps,
    extend_outside,
    place,
    shape_maps,
)
from .network import Network
from .resize import resize


def mean_planes(
    network: Network,
    sides: Sequence[int],
    lines: NDArray[np.float32],
    mask: NDArray[np.bool_],
    strokes: Sequence[BendStroke] = (),
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """The mean prediction over canvases of several ``sides``, the largest last.

    On a small canvas the network sees the whole, on a large one the parts, and its errors
    differ. Arguments and result as in ``character_planes``, at the largest size.
    """
    *smaller, largest = sides
    planes, seen = character_planes(network, largest, lines, mask, strokes)
    for side in smaller:
        rough = extend_outside(*character_planes(network, side, lines, mask, strokes))
        planes += resize(rough, seen.shape)
    return planes / float(len(sides)), seen


def character_planes(
    network: Network,
    side: int,
    lines: NDArray[np.float32],
    mask: NDArray[np.bool_],
    strokes: Sequence[BendStroke] = (),
    *,
    mirrored: bool = True,
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """The prediction for one character, at the resolution of its canvas.

    Args:
        network: one of whole characters.
        side: size of the canvas, as the side in pixels of a square of equal area.
        lines: (H, W) float32 ink in 0..1. mask: (H, W) bool. Both cropped to the character.
        strokes: what the artist says of round and hollow parts, in the same pixels.
        mirrored: average with the prediction for the mirror image, so that a mirrored
            character gets exactly mirrored normals; this doubles the cost.

    Returns:
        (h, w, 5) float32: the normal, roughly unit; the depth towards the viewer, in longer
        sides of the box; how likely the pixel lies at an occlusion, 0 to 1. And
        the (h, w) bool mask at that size.
    """
    rows, columns = mask.shape
    canvas = canvas_for((rows, columns), side)
    fine, coarse, small = character_input(lines, mask, canvas, strokes)
    if mirrored:
        flipped = coarse[..., ::-1].copy()
        flipped[:, list(SIDEWAYS)] *= -1
        fine = np.concatenate([fine, fine[..., ::-1]])
        coarse = np.concatenate([coarse, flipped])
    vectors, auxiliary = network.predict_character(fine, coarse)
    vectors /= np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12)
    edge = expit(auxiliary[:, 1:3].max(axis=1, keepdims=True))
    cells = np.concatenate([auxiliary[:, :1], edge], axis=1)
    if mirrored:
        back = vectors[1, :, :, ::-1].copy()
        back[0] *= -1
        vectors = np.divide(vectors[:1] + back, 2, dtype=np.float32)
        cells = (cells[:1] + cells[1:, :, :, ::-1]) / 2
    planes = np.concatenate([_channels_last(vectors), _spread(_channels_last(cells), small)], 2)
    return planes[canvas.inner], small[canvas.inner]


def _channels_last(batch: NDArray[np.float32]) -> NDArray[np.float32]:
    return np.ascontiguousarray(batch[0].transpose(1, 2, 0), np.float32)


def _spread(cells: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """(h, w, C) cells -> (H, W, C), the size of ``mask``. Cells outside are not trained, so none of
    them are mixed in."""
    touched = mask.reshape(cells.shape[0], COARSE, cells.shape[1], COARSE).any(axis=(1, 3))
    return resize(extend_outside(cells, touched), mask.shape)


def character_input(
    lines: NDArray[np.float32],
    mask: NDArray[np.bool_],
    canvas: Canvas,
    strokes: Sequence[BendStroke] = (),
) -> tuple[NDArray[np.float32], NDArray[np.float32], NDArray[np.bool_]]:
    """The fine (1, 2, h, w) and coarse (1, 11, h/4, w/4) input, and the (h, w) mask."""
    placed = place(np.stack([lines * mask, mask], axis=2).astype(np.float32), canvas)
    share = placed[..., 1]
    small = share > 0.5
    if not small.any():
        small = share >= share.max()
    inside = small.astype(np.float32)
    ink = np.clip(np.divide(placed[..., 0], np.maximum(share, 0.25)), 0, 1) * inside
    fine = np.stack([ink, inside])[None]
    hints = stroke_cells(strokes, mask.shape, canvas)
    return fine.astype(np.float32), coarse_maps(shape_maps(small), ink, hints)[None], small
