"""A whole normal map from a drawing: multi-grid diagonal sampling (paper, 3.1.4)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import torch
from numpy.typing import NDArray
from scipy import ndimage
from torch import nn

from .. import __version__
from ..cache import digest
from .card import NetworkCard, load_network
from .tiles import TILE, TileSource, diagonal_grids

DEFAULT_GRIDS = 5
MAX_GRIDS = 64
ROUNDNESS = 1.5
"""Factor on the slopes. On the validation models 1.5 brings the mean tilt away from the viewer
within 4 degrees of the truth, from 13, for 0.2 degrees of mean angle; 1.2 serves the angle best,
0.4 degrees better than 1.5."""

_BATCH = 8


class NormalPredictor:
    """A trained network, ready to predict. Loads the shipped weights by default.

    ``identity`` names the weights, so that results can be kept for as long as they hold.

    Raises:
        LampblackError: the weights cannot be used (see ``load_network``).
    """

    def __init__(self, network: nn.Module | None = None, card: NetworkCard | None = None) -> None:
        if network is None or card is None:
            network, card = load_network()
        self._network = network.to(memory_format=torch.channels_last).eval()  # type: ignore[call-overload]
        self.card = card
        self.identity = digest(
            __version__,
            ROUNDNESS,
            card,
            *(tensor.numpy() for tensor in self._network.state_dict().values()),
        )

    def predict(
        self,
        lines: NDArray[np.float32],
        mask: NDArray[np.bool_],
        *,
        grids: int = DEFAULT_GRIDS,
        progress: Callable[[float], None] = lambda share: None,
    ) -> NDArray[np.float32]:
        """Predict the normals of one drawing.

        Args:
            lines: (H, W) float32 ink in 0..1.
            mask: (H, W) bool.
            grids: how many diagonally shifted grids are averaged, 1 to 64.
            progress: told the share done, 0 to 1.

        Returns:
            (H, W, 3) float32, x right, y up, z to the viewer; unit in the mask, 0 outside.

        Raises:
            ValueError: shapes differ, or ``grids`` is out of range.
        """
        if lines.shape != mask.shape or lines.ndim != 2:
            raise ValueError(f"lines {lines.shape} and mask {mask.shape} must be equal (H, W)")
        if not 1 <= grids <= MAX_GRIDS:
            raise ValueError(f"grids must be 1 to {MAX_GRIDS}, not {grids}")
        normals = np.zeros((*mask.shape, 3), np.float32)
        if not mask.any():
            return normals
        # Everything is measured from the figure's own box, so that a figure that moves across
        # the canvas keeps its normals to the last bit.
        box = _bounding_box(mask)
        figure_lines, figure_mask, inner = _past_the_canvas(lines[box], mask[box], box, mask.shape)
        scale = self._scale(max(figure_mask.shape))
        small_lines, small_mask = _resize_figure(figure_lines, figure_mask, scale)
        vectors = self._average_grids(small_lines, small_mask, grids, progress)
        vectors = _extend_outside(_round_off(vectors), small_mask)
        vectors = _resize(vectors, figure_mask.shape)[inner]
        figure_mask = figure_mask[inner]
        vectors[..., 2] = np.maximum(vectors[..., 2], 1e-3)  # what is seen cannot face away
        vectors /= np.linalg.norm(vectors, axis=2, keepdims=True)
        normals[box] = vectors * figure_mask[..., None]
        return normals

    def _scale(self, long_side: int) -> float:
        smallest, largest = self.card.figure_px
        return min(max(long_side, smallest), largest) / long_side

    def _average_grids(
        self,
        lines: NDArray[np.float32],
        mask: NDArray[np.bool_],
        grids: int,
        progress: Callable[[float], None],
    ) -> NDArray[np.float32]:
        height, width = mask.shape
        source = TileSource(lines, mask)
        corners = [
            (row, column)
            for grid in diagonal_grids(height, width, grids)
            for row, column in grid
            if mask[max(row, 0) : row + TILE, max(column, 0) : column + TILE].any()
        ]
        # Tiles know their middle best: each counts less towards its border.
        ramp = np.minimum(np.arange(TILE) + 0.5, TILE - np.arange(TILE) - 0.5) / (TILE / 2)
        window = (np.outer(ramp, ramp) + 1e-3).astype(np.float32)[..., None]
        summed = np.zeros((height + 2 * TILE, width + 2 * TILE, 3), np.float32)
        weights = np.zeros((*summed.shape[:2], 1), np.float32)
        for start in range(0, len(corners), _BATCH):
            batch = corners[start : start + _BATCH]
            tiles = torch.from_numpy(np.stack([source.cut(*corner) for corner in batch]))
            tiles = tiles.contiguous(memory_format=torch.channels_last)
            with torch.inference_mode(), torch.autocast("cpu", torch.bfloat16):
                predicted = self._network(tiles).float().permute(0, 2, 3, 1).numpy()
            for (row, column), vectors in zip(batch, predicted, strict=True):
                area = np.s_[row + TILE : row + 2 * TILE, column + TILE : column + 2 * TILE]
                summed[area] += vectors * window
                weights[area] += window
            progress((start + len(batch)) / len(corners))
        inner = np.s_[TILE : TILE + height, TILE : TILE + width]
        result: NDArray[np.float32] = summed[inner] / np.maximum(weights[inner], 1e-6)
        return result


def _round_off(vectors: NDArray[np.float32]) -> NDArray[np.float32]:
    """Unit normals from the network's means, (H, W, 3), without their flatness.

    A mean of the normals that a pixel might have leans to the viewer: what points sideways
    cancels out, what points forwards does not. Steepening every slope by one factor undoes
    the lean on the whole, and makes no crease where there was none.
    """
    steeper = np.maximum(vectors, [-1, -1, 1e-3]) / [1, 1, ROUNDNESS]
    rounded = steeper / np.linalg.norm(steeper, axis=2, keepdims=True)
    result: NDArray[np.float32] = rounded.astype(np.float32)
    return result


def _bounding_box(mask: NDArray[np.bool_]) -> tuple[slice, slice]:
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    return slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)


def _past_the_canvas(
    lines: NDArray[np.float32],
    mask: NDArray[np.bool_],
    box: tuple[slice, slice],
    canvas: tuple[int, ...],
) -> tuple[NDArray[np.float32], NDArray[np.bool_], tuple[slice, slice]]:
    """Carry a figure on where the canvas cuts it off: there it does not end, so it must not
    be rounded off. An outline that merely touches the canvas's edge ends there.

    Returns lines, mask and the place of the original in them.
    """
    reach = max(mask.shape) // 6
    pads = [
        (reach if side.start == 0 else 0, reach if side.stop == size else 0)
        for side, size in zip(box, canvas, strict=True)
    ]
    inner = tuple(slice(p[0], p[0] + n) for p, n in zip(pads, mask.shape, strict=True))
    place = inner[0], inner[1]
    carried, drawn = np.pad(mask, pads, "edge"), np.pad(lines, pads, "edge")
    carried &= drawn < 0.3
    carried[place], drawn = mask, drawn * carried
    drawn[place] = lines
    return drawn.astype(np.float32), carried, place


def _resize_figure(
    lines: NDArray[np.float32], mask: NDArray[np.bool_], scale: float
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    if scale == 1:
        return lines, mask
    size = tuple(max(1, round(side * scale)) for side in mask.shape)
    inside = _resize(mask.astype(np.float32)[..., None], size)[..., 0]
    ink = _resize((lines * mask)[..., None], size)[..., 0] / np.maximum(inside, 0.25)
    small_mask = inside > 0.5
    if not small_mask.any():
        small_mask = inside >= inside.max()
    return np.clip(ink, 0, 1).astype(np.float32), small_mask


def _resize(image: NDArray[np.float32], size: tuple[int, ...]) -> NDArray[np.float32]:
    """Area-averaging when smaller, bilinear when larger; pixel borders stay aligned."""
    if image.shape[:2] == tuple(size):
        return image.copy()
    planes = torch.from_numpy(np.ascontiguousarray(image)).permute(2, 0, 1)[None]
    resized = nn.functional.interpolate(
        planes, size=tuple(size), mode="bilinear", antialias=True, align_corners=False
    )
    return resized[0].permute(1, 2, 0).contiguous().numpy()


def _extend_outside(vectors: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Continue the nearest normal past the border, so that resizing mixes in no zeros."""
    nearest = ndimage.distance_transform_edt(~mask, return_distances=False, return_indices=True)
    result: NDArray[np.float32] = vectors[tuple(nearest)]
    return result
