"""Overlaps of a drawing as they are sent: few points, in pixels of the canvas."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from ..camera import Affine
from ..choices import FrontSide
from ..protocol import Overlap as SentOverlap
from ..protocol import OverlapPoint
from ..surface.overlap import Overlap

MAX_OVERLAPS, MAX_POINTS = 128, 32
_MIRRORED: Final[dict[FrontSide, FrontSide]] = {
    "left": "right",
    "right": "left",
    "joined": "joined",
}


def overlaps_on_canvas(overlaps: Sequence[Overlap], camera: Affine) -> tuple[SentOverlap, ...]:
    """The first overlaps, in pixels of the canvas.

    Args:
        camera: from the canvas to the drawing.
    """
    a, b, c, d, e, f = camera
    area = a * e - b * d
    if abs(area) < 1e-9:
        return ()
    back = np.linalg.inv(np.array([[a, b], [d, e]]))
    sent = []
    for overlap in overlaps[:MAX_OVERLAPS]:
        count = min(len(overlap.points), MAX_POINTS)
        kept = overlap.points[np.linspace(0, len(overlap.points) - 1, count).round().astype(int)]
        points = (kept.astype(np.float64) - [c, f]) @ back.T
        sent.append(
            SentOverlap(
                points=tuple(OverlapPoint(x=float(x), y=float(y)) for x, y in points),
                front=overlap.front if area > 0 else _MIRRORED[overlap.front],
                amount=float(overlap.amount) / abs(area) ** 0.5,
                hinted=overlap.hinted,
            )
        )
    return tuple(sent)
