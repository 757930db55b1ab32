"""Hints of depth, carried from the drawings on which they were made to other drawings."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .cache import digest as digest_of
from .drawing import Drawing
from .normals.temporal.carry import carry_points
from .normals.temporal.temporal_filter import TemporalFilter
from .normals.temporal.thumbnail import RegistrationThumbnail, make_thumbnail
from .scene import Depth, DepthHint, DepthPoint

HINT_REACH = 48
"""Frames before and after its own for which a hint counts."""
_SAME_PLACE = 0.03
"""Two hints are about one place if their middles are nearer than this share of the character's
longer side; then the one that is nearer in time counts."""


@dataclass(frozen=True, eq=False)
class HintedDrawing:
    """A drawing with the hints that were made on it, in its own pixels."""

    drawing: Drawing
    hints: tuple[DepthHint, ...]


def hint_frames(depth: Depth, frame: int) -> list[int]:
    """The frames whose hints count at ``frame``, the nearest first."""
    frames = {hint.frame for hint in depth.hints if abs(hint.frame - frame) <= HINT_REACH}
    return sorted(frames, key=lambda hinted: (abs(hinted - frame), hinted))


def carry_hints(
    hinted: Iterable[HintedDrawing], target: Drawing, temporal_filter: TemporalFilter
) -> tuple[DepthHint, ...]:
    """The hints of other drawings, in pixels of ``target``.

    Hints of a drawing equal to ``target`` stay where they are. A hint is dropped where the two
    drawings differ too much, and where a hint of a nearer frame says something about the place.

    Args:
        hinted: the nearest in time first.
        temporal_filter: caches registrations.
    """
    there = _thumbnail(target)
    reach = _SAME_PLACE * max(there.window.size)
    found: list[DepthHint] = []
    for source in hinted:
        here = _thumbnail(source.drawing)
        nearer = [_middle(hint) for hint in found]
        for hint in source.hints:
            carried = _carried(hint, here, there, temporal_filter)
            if carried is None:
                continue
            middle = _middle(carried)
            if all(np.hypot(*(middle - other)) > reach for other in nearer):
                found.append(carried)
    return tuple(found)


def _carried(
    hint: DepthHint,
    here: RegistrationThumbnail,
    there: RegistrationThumbnail,
    temporal_filter: TemporalFilter,
) -> DepthHint | None:
    if here.name == there.name or not hint.points:
        return hint
    points = np.array([(p.x, p.y) for p in hint.points], np.float32)
    moved = carry_points(points, here, there, temporal_filter.registration(here, there))
    if moved is None:
        return None
    return replace(hint, points=tuple(DepthPoint(float(x), float(y)) for x, y in moved))


def _middle(hint: DepthHint) -> NDArray[np.float64]:
    points = np.array([(p.x, p.y) for p in hint.points] or [(np.inf, np.inf)])
    middle: NDArray[np.float64] = points.mean(axis=0)
    return middle


def _thumbnail(drawing: Drawing) -> RegistrationThumbnail:
    """Normals have no part in a registration."""
    name = digest_of("hints", drawing.lines, drawing.mask, drawing.albedo)
    flat = np.zeros((*drawing.mask.shape, 3), np.float32)
    return make_thumbnail(name, drawing.lines, drawing.mask, drawing.albedo, flat)
