"""Normal maps, depths and occlusions predicted from drawings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..cache import digest, program_digest
from ..choices import DEFAULT_GRIDS
from .bend_strokes import BendStroke
from .card import NetworkCard
from .character import bounding_box, extend_outside
from .follow_strokes import follow_strokes
from .network import Network, shipped_network
from .predict_character import mean_planes
from .predict_tiles import MAX_GRIDS, tile_vectors
from .prediction import Prediction
from .resize import resize

_TILE_GRIDS = 5


class NormalPredictor:
    """A trained network, ready to predict. Loads the shipped weights by default.

    ``identity`` is a digest of the weights: a key for caches of the results.

    Args:
        network, card: a network to use instead of the shipped one.

    Raises:
        LampblackError: the shipped weights cannot be used.
    """

    def __init__(self, network: Network | None = None, card: NetworkCard | None = None) -> None:
        if network is None or card is None:
            network, card = shipped_network()
        self._network = network
        self.card = card
        self.identity: str = digest(program_digest(), card, network.identity)

    def predict(
        self,
        lines: NDArray[np.float32],
        mask: NDArray[np.bool_],
        *,
        grids: int = DEFAULT_GRIDS,
        quick: bool = False,
        strokes: Sequence[BendStroke] = (),
        progress: Callable[[float], None] = lambda share: None,
    ) -> Prediction:
        """Predict the normals of one drawing, and its depth and occlusions from the same pass.

        Args:
            lines: (H, W) float32 ink in 0..1.
            mask: (H, W) bool.
            grids: 0 predicts the whole character at once. 1 to 64 uses the paper's network on
                that many diagonally shifted grids of tiles. A network of tiles uses 5 for 0.
            quick: predict a whole character on the smallest canvas only.
            strokes: what the artist says of round and hollow parts, in pixels of ``mask``. A
                network of tiles is not told, but its normals follow them.
            progress: called with the share done, 0 to 1.

        Returns:
            The prediction; a network of tiles predicts normals alone.

        Raises:
            ValueError: shapes differ, or ``grids`` is out of range.
        """
        if lines.shape != mask.shape or lines.ndim != 2:
            raise ValueError(f"lines {lines.shape} and mask {mask.shape} must be equal (H, W)")
        if not 0 <= grids <= MAX_GRIDS:
            raise ValueError(f"grids must be 0 to {MAX_GRIDS}, not {grids}")
        whole = self._network.whole
        if whole and grids:
            return self._paper.predict(lines, mask, grids=grids, strokes=strokes, progress=progress)
        normals = np.zeros((*mask.shape, 3), np.float32)
        depth, edge = (np.zeros(mask.shape, np.float32) if whole else None for _ in range(2))
        if not mask.any():
            return Prediction(normals, depth, edge)
        # Everything is relative to the character's box, so that a character that moves across
        # the canvas keeps its normals to the last bit.
        box = bounding_box(mask)
        character_lines, character_mask, inner = _past_the_canvas(
            lines[box], mask[box], box, mask.shape
        )
        if whole:
            sides = self.card.figure_px[: 1 if quick else None]
            right, down = inner[1].start - box[1].start, inner[0].start - box[0].start
            planes, seen = mean_planes(
                self._network,
                sides,
                character_lines,
                character_mask,
                [stroke.moved(right, down) for stroke in strokes],
            )
        else:
            scale = self._scale(max(character_mask.shape))
            small_lines, seen = _resize_drawing(character_lines, character_mask, scale)
            planes = tile_vectors(self._network, small_lines, seen, grids or _TILE_GRIDS, progress)
        planes[..., :3] = _correct_slopes(planes[..., :3], self.card.roundness)
        planes = resize(extend_outside(planes, seen), character_mask.shape)[inner]
        vectors, inside = planes[..., :3], mask[box]
        vectors[..., 2] = np.maximum(vectors[..., 2], 1e-3)  # what is seen cannot face away
        vectors /= np.linalg.norm(vectors, axis=2, keepdims=True)
        vectors *= inside[..., None]
        follow_strokes(vectors, inside, [s.moved(-box[1].start, -box[0].start) for s in strokes])
        normals[box] = vectors
        if depth is not None and edge is not None:
            depth[box] = planes[..., 3] * max(character_mask.shape) * inside
            edge[box] = planes[..., 4] * inside
        progress(1.0)
        return Prediction(normals, depth, edge)

    @cached_property
    def _paper(self) -> NormalPredictor:
        return NormalPredictor(*shipped_network("dilated-unet"))

    def _scale(self, long_side: int) -> float:
        smallest, *_, largest = self.card.figure_px
        return min(max(long_side, smallest), largest) / long_side


def _correct_slopes(vectors: NDArray[np.float32], roundness: float) -> NDArray[np.float32]:
    """Slope correction: unit normals from the network's means, (H, W, 3).

    A mean over the normals that a pixel may have leans towards the viewer, because sideways
    components cancel out. Multiplying every slope by one factor corrects this on average,
    and adds no creases.
    """
    steeper = np.maximum(vectors, [-1, -1, 1e-3]) / [1, 1, roundness]
    rounded = steeper / np.linalg.norm(steeper, axis=2, keepdims=True)
    result: NDArray[np.float32] = rounded.astype(np.float32)
    return result


def _past_the_canvas(
    lines: NDArray[np.float32],
    mask: NDArray[np.bool_],
    box: tuple[slice, slice],
    canvas: tuple[int, ...],
) -> tuple[NDArray[np.float32], NDArray[np.bool_], tuple[slice, slice]]:
    """Extend a character where the canvas cuts it off, so that it is not rounded there. An
    outline that only touches the canvas's edge ends there.

    Returns lines, mask, and the rows and columns of the original in them.
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


def _resize_drawing(
    lines: NDArray[np.float32], mask: NDArray[np.bool_], scale: float
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    if scale == 1:
        return lines, mask
    size = tuple(max(1, round(side * scale)) for side in mask.shape)
    inside = resize(mask.astype(np.float32)[..., None], size)[..., 0]
    ink = resize((lines * mask)[..., None], size)[..., 0] / np.maximum(inside, 0.25)
    small_mask = inside > 0.5
    if not small_mask.any():
        small_mask = inside >= inside.max()
    return np.clip(ink, 0, 1).astype(np.float32), small_mask
