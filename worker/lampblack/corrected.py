"""What the artist corrects on the surface of a drawing, after its prediction or in it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .drawing import Drawing
from .hints import scaled_hint
from .normals.bend_strokes import HOLLOW, ROUND, BendStroke
from .prepared import block_middles
from .scene import DepthColour, DepthStroke, Hint
from .surface import Corrections, character_length, normals_of

BENDS = {"round": ROUND, "hollow": HOLLOW}
"""The brushes whose strokes the network is told, see ``bend_strokes``."""


def bend_strokes(hints: Sequence[Hint]) -> list[BendStroke]:
    """What ``hints`` tell the network, in their pixels."""
    return [
        BendStroke(np.array([(p.x, p.y) for p in hint.points], np.float32), BENDS[hint.brush])
        for hint in hints
        if isinstance(hint, DepthStroke) and hint.brush in BENDS and hint.points
    ]


def corrections_of(
    drawing: Drawing, mask: NDArray[np.bool_], hints: Sequence[Hint], step: int
) -> Corrections:
    """The corrections of the surface, whose ``mask`` has pixels of ``step`` of the drawing's."""
    strokes = [
        scaled_hint(hint, 1 / step)
        for hint in hints
        if isinstance(hint, DepthStroke) and hint.brush not in BENDS
    ]
    colours = [hint for hint in hints if isinstance(hint, DepthColour)]
    rows, columns = mask.shape
    labels = block_middles(drawing.labels, step)[:rows, :columns]
    return Corrections.of(strokes, colours, labels, drawing.palette.colours, character_length(mask))


def corrected_normals(
    drawing: Drawing,
    normals: NDArray[np.float32],
    height: NDArray[np.float32],
    hints: Sequence[Hint],
    step: int,
) -> NDArray[np.float32]:
    """``normals`` of the drawing; where its surface was corrected, those of ``height``."""
    mask = block_middles(drawing.mask, step)[: height.shape[0], : height.shape[1]]
    corrections = corrections_of(drawing, mask, hints, step)
    if not corrections:
        return normals
    found = np.where(
        corrections.touched(mask)[..., None], normals_of(height / np.float32(step), mask), 0
    )
    found = found.repeat(step, axis=0).repeat(step, axis=1)
    rows, columns = drawing.mask.shape
    more = (0, max(0, rows - found.shape[0])), (0, max(0, columns - found.shape[1])), (0, 0)
    found = np.pad(found, more)[:rows, :columns]
    known = found.any(axis=2, keepdims=True) & drawing.mask[..., None]
    return np.where(known, found, normals).astype(np.float32)
