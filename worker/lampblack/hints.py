"""Hints of depth, carried from the drawings on which they were made to other drawings."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .cache import digest as digest_of
from .drawing import Body, Drawing
from .normals.temporal.carry import carry_points
from .normals.temporal.temporal_filter import TemporalFilter
from .normals.temporal.thumbnail import RegistrationThumbnail, make_thumbnail
from .scene import Depth, DepthHint, DepthPoint

HINT_REACH = 48
"""Frames before and after its own for which a hint counts."""
MOST_FRAMES = 8
"""Frames whose hints count at one frame."""
_SAME_PLACE = 0.03
"""Two hints are about one place if their middles are nearer than this share of the character's
longer side; then the one that is nearer in time counts."""


@dataclass(frozen=True, eq=False)
class HintedDrawing:
    """A drawing with the hints that were made on it, in its own pixels."""

    drawing: Drawing
    hints: tuple[DepthHint, ...]


def scaled_hint(hint: DepthHint, scale: float, left: float = 0, top: float = 0) -> DepthHint:
    """The hint in a picture that begins at (``left``, ``top``) and then is scaled."""
    points = tuple(replace(p, x=(p.x - left) * scale, y=(p.y - top) * scale) for p in hint.points)
    return replace(hint, points=points)


def hints_by_body(
    bodies: Sequence[Body], hints: Sequence[DepthHint]
) -> list[tuple[DepthHint, ...]]:
    """For each of ``bodies``, bottom first, its hints in its own pixels: those of whose points it
    is the topmost body at the most."""
    found: list[list[DepthHint]] = [[] for _ in bodies]
    for hint in hints:
        seen = [0] * len(bodies)
        for point in hint.points:
            for number in reversed(range(len(bodies))):
                body = bodies[number]
                row, column = int(point.y) - body.top, int(point.x) - body.left
                height, width = body.drawing.mask.shape
                if 0 <= row < height and 0 <= column < width and body.drawing.mask[row, column]:
                    seen[number] += 1
                    break
        number = int(np.argmax(seen))
        if seen[number]:
            found[number].append(scaled_hint(hint, 1, bodies[number].left, bodies[number].top))
    return [tuple(own) for own in found]


def hint_frames(depth: Depth, frame: int) -> list[int]:
    """The frames whose hints count at ``frame``, the nearest first."""
    frames = {hint.frame for hint in depth.hints if abs(hint.frame - frame) <= HINT_REACH}
    return sorted(frames, key=lambda hinted: (abs(hinted - frame), hinted))[:MOST_FRAMES]


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
    hinted = tuple(hinted)
    reach = _SAME_PLACE * max(target.mask.any(axis=1).sum(), target.mask.any(axis=0).sum())
    there = None
    found: list[DepthHint] = []
    for source in hinted:
        nearer = [_middle(hint) for hint in found]
        here = None
        if source.drawing is not target:
            there = there or _thumbnail(target)
            here = _thumbnail(source.drawing)
        for hint in source.hints:
            carried: DepthHint | None = hint
            if here is not None and there is not None:
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
