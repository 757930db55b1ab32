"""Measures flicker: how much normals change from drawing to drawing.

Not all change is flicker, because characters move. So the change is measured after the rigid
motion of the character is removed; after the motion of each place is removed, where two drawings
can be registered; and as the departure from the mean of the drawings before and after, which is 0
for an even change.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace
from math import nan

import numpy as np
from numpy.typing import NDArray

from lampblack.normals.temporal.registration import Registration, rigid_registration
from lampblack.normals.temporal.temporal_filter import (
    LazyNeighbours,
    Neighbours,
    TemporalFilter,
    warped_normals,
)
from lampblack.normals.temporal.thumbnail import RegistrationThumbnail
from lampblack.normals.temporal.window import Planes


@dataclass(frozen=True)
class Flicker:
    """Means over pairs, or triples, of consecutive drawings, in degrees; nan where there are none.

    Attributes:
        rigid: change after the rigid motion of the character is removed.
        motion: the part of ``rigid`` that moving parts make: the change if every place kept its
            normal as it moved. No filter can come below it.
        local: change after the motion of each place is removed.
        jitter: departure from the mean of the drawings before and after, place by place.
    """

    rigid: float
    motion: float
    local: float
    jitter: float


class FlickerMeter:
    """Measures distinct drawings in order; keeps the last two.

    Args:
        temporal_filter: used for its registrations only; meters may share one.
    """

    def __init__(self, temporal_filter: TemporalFilter) -> None:
        self._temporal_filter = temporal_filter
        self._last: deque[RegistrationThumbnail] = deque(maxlen=2)
        self._rigid: list[float] = []
        self._motion: list[float] = []
        self._local: list[float] = []
        self._jitter: list[float] = []

    def add(self, later: RegistrationThumbnail) -> None:
        """Add the next drawing, with its normals."""
        if self._last:
            here = self._last[-1]
            ahead = self._temporal_filter.registration(here, later)
            whole = rigid_registration(here, later)
            self._rigid.append(_change(here, later, whole))
            kept, _ = warped_normals(here, self._temporal_filter.registration(later, here).fine())
            self._motion.append(_change(here, replace(later, vectors=kept), whole))
            self._local.append(_change(here, later, ahead))
            if len(self._last) == 2:
                earlier = self._last[0]
                past, faith = warped_normals(
                    earlier, self._temporal_filter.registration(here, earlier).fine()
                )
                future, trust = warped_normals(later, ahead.fine())
                self._jitter.append(_mean_angle(here, past + future, faith * trust))
        self._last.append(later)

    @property
    def flicker(self) -> Flicker:
        """The means over all drawings so far."""
        found = self._rigid, self._motion, self._local, self._jitter
        return Flicker(*(float(np.mean(values)) if values else nan for values in found))


def lazy_neighbours(around: Neighbours) -> LazyNeighbours:
    """Neighbours that are loaded, as a pipeline takes them."""
    names = [tuple(other.name for other in side) for side in (around.before, around.after)]
    return LazyNeighbours((names[0], names[1]), lambda: around)


def rigid_change(here: RegistrationThumbnail, later: RegistrationThumbnail) -> float:
    """Change in degrees after the rigid motion of the character is removed."""
    return _change(here, later, rigid_registration(here, later))


def _change(here: RegistrationThumbnail, other: RegistrationThumbnail, seen: Registration) -> float:
    return _mean_angle(here, *warped_normals(other, seen.fine()))


def _mean_angle(here: RegistrationThumbnail, vectors: Planes, weight: NDArray[np.float32]) -> float:
    """Degrees between the drawing's normals and ``vectors``, over the character."""
    length = np.linalg.norm(here.vectors, axis=0) * np.linalg.norm(vectors, axis=0)
    cosine = (here.vectors * vectors).sum(axis=0) / np.maximum(length, 1e-6)
    within = weight * (here.inside > 0.5)
    angles = np.degrees(np.arccos(np.clip(cosine, -1, 1)))
    return float((angles * within).sum() / max(float(within.sum()), 1e-6))
