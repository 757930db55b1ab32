"""What the artist says of the surface, carried from the drawings on which it was said to others."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from .cache import digest as digest_of
from .drawing import Body, Drawing
from .normals.temporal.carry import carry_points
from .normals.temporal.temporal_filter import TemporalFilter
from .normals.temporal.thumbnail import RegistrationThumbnail, make_thumbnail
from .scene import Depth, DepthColour, DepthHint, DepthPoint, DepthStroke, Drawn, Hint

HINT_REACH = 48
"""Frames before and after its own for which a hint counts."""
MOST_FRAMES = 8
"""Frames whose hints count at one frame."""
_SAME_PLACE = 0.03
"""Two hints are about one place if their middles are nearer than this share of the character's
longer side; then the one that is nearer in time counts."""


Stroke = TypeVar("Stroke", DepthHint, DepthStroke, Drawn)


@dataclass(frozen=True, eq=False)
class HintedDrawing:
    """A drawing with the hints and strokes that were made on it, in its own pixels."""

    drawing: Drawing
    hints: tuple[Drawn, ...]


def scaled_hint(hint: Stroke, scale: float, left: float = 0, top: float = 0) -> Stroke:
    """The hint in a picture that begins at (``left``, ``top``) and then is scaled."""
    points = tuple(replace(p, x=(p.x - left) * scale, y=(p.y - top) * scale) for p in hint.points)
    return hint.placed(points, scale)


def hints_by_body(bodies: Sequence[Body], hints: Sequence[Hint]) -> list[tuple[Hint, ...]]:
    """For each of ``bodies``, bottom first, its hints in its own pixels: those of whose points it
    is the topmost body at the most. What is said of colours is said of all bodies."""
    found: list[list[Hint]] = [[] for _ in bodies]
    for hint in hints:
        if isinstance(hint, DepthColour):
            for own in found:
                own.append(hint)
            continue
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
    return [tuple(said) for said in found]


def hint_frames(depth: Depth, frame: int) -> list[int]:
    """The frames whose hints count at ``frame``, the nearest first."""
    frames = {hint.frame for hint in depth.drawn if abs(hint.frame - frame) <= HINT_REACH}
    return sorted(frames, key=lambda hinted: (abs(hinted - frame), hinted))[:MOST_FRAMES]


def carry_hints(
    hinted: Iterable[HintedDrawing], target: Drawing, temporal_filter: TemporalFilter
) -> tuple[Drawn, ...]:
    """The hints and strokes of other drawings, in pixels of ``target``.

    Those of a drawing equal to ``target`` stay where they are. They are dropped where the two
    drawings differ too much. Where hints of several frames say something about one place, the
    nearest counts; strokes add up.

    Args:
        hinted: the nearest in time first.
        temporal_filter: caches registrations.
    """
    hinted = tuple(hinted)
    reach = _SAME_PLACE * max(target.mask.any(axis=1).sum(), target.mask.any(axis=0).sum())
    there = None
    found: list[Drawn] = []
    for source in hinted:
        nearer = [_middle(hint) for hint in found if isinstance(hint, DepthHint)]
        here = None
        if source.drawing is not target:
            there = there or _thumbnail(target)
            here = _thumbnail(source.drawing)
        for hint in source.hints:
            carried: Drawn | None = hint
            if here is not None and there is not None:
                carried = _carried(hint, here, there, temporal_filter)
            if carried is None:
                continue
            middle = _middle(carried)
            if isinstance(carried, DepthStroke) or all(
                np.hypot(*(middle - other)) > reach for other in nearer
            ):
                found.append(carried)
    return tuple(found)


def _carried(
    hint: Drawn,
    here: RegistrationThumbnail,
    there: RegistrationThumbnail,
    temporal_filter: TemporalFilter,
) -> Drawn | None:
    if here.name == there.name or not hint.points:
        return hint
    points = np.array([(p.x, p.y) for p in hint.points], np.float32)
    moved = carry_points(points, here, there, temporal_filter.registration(here, there))
    if moved is None:
        return None
    return hint.placed(tuple(DepthPoint(float(x), float(y)) for x, y in moved))


def _middle(hint: Drawn) -> NDArray[np.float64]:
    points = np.array([(p.x, p.y) for p in hint.points] or [(np.inf, np.inf)])
    middle: NDArray[np.float64] = points.mean(axis=0)
    return middle


def _thumbnail(drawing: Drawing) -> RegistrationThumbnail:
    """Normals have no part in a registration."""
    name = digest_of("hints", drawing.lines, drawing.mask, drawing.albedo)
    flat = np.zeros((*drawing.mask.shape, 3), np.float32)
    return make_thumbnail(name, drawing.lines, drawing.mask, drawing.albedo, flat)
