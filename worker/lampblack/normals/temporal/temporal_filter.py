"""Steady normals: each drawing's prediction averaged with its neighbours', laid onto it.

Where two drawings show the same thing, their predictions differ by the network's whim alone, and
the mean of several is steadier than each. The mean looks equally far back and ahead, so that it
does not lag; it takes nothing from where the drawings differ; and it is the same in whatever
order frames are asked for.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from .neighbours import NeighbourKeys
from .registration import Registration, places_in, registration
from .sample import sampled
from .thumbnail import RegistrationThumbnail
from .window import Planes

REACH = 2
"""Drawings that are looked at to either side."""
_KEPT = 16


@dataclass(frozen=True)
class Neighbours:
    """What precedes and follows a drawing, nearest first; ``REACH`` of each are looked at."""

    before: tuple[RegistrationThumbnail, ...] = ()
    after: tuple[RegistrationThumbnail, ...] = ()


@dataclass(frozen=True)
class LazyNeighbours:
    """Neighbours that are loaded only when they are needed. ``keys`` name their contents."""

    keys: NeighbourKeys
    load: Callable[[], Neighbours]


NO_NEIGHBOURS = Neighbours()


class TemporalFilter:
    """Steadies normals, drawing by drawing.

    Keeps the last few registrations, since each serves several drawings. What it returns does
    not depend on what it was asked before.
    """

    def __init__(self) -> None:
        self._places: OrderedDict[tuple[str, str], Planes] = OrderedDict()

    def smooth(
        self,
        normals: NDArray[np.float32],
        mask: NDArray[np.bool_],
        here: RegistrationThumbnail,
        neighbours: Neighbours,
    ) -> NDArray[np.float32]:
        """Average one drawing's normals with its neighbours'.

        Args:
            normals: (H, W, 3) float32, as predicted. mask: (H, W) bool.
            here: of this drawing. neighbours: of its neighbours, which may be of other sizes.

        Returns:
            (H, W, 3) float32, x right, y up, z to the viewer; unit in the mask, 0 outside.
            Detail finer than the fine grid is the drawing's own.
        """
        laid, place = here.window.lay(self.change(here, neighbours), mask.shape)
        inside = mask[place]
        moved = normals[place][inside] + laid[inside]
        moved[:, 2] = np.maximum(moved[:, 2], 1e-3)  # what is seen cannot face away
        steadied = normals.copy()
        steadied[place][inside] = moved / np.linalg.norm(moved, axis=1, keepdims=True)
        return steadied

    def change(self, here: RegistrationThumbnail, neighbours: Neighbours) -> Planes:
        """(3, h, w) float32: what brings ``here.vectors`` to the mean, on the fine grid."""
        summed = np.zeros_like(here.vectors)
        weights = np.ones(here.inside.shape, np.float32)
        for side in (neighbours.before[:REACH], neighbours.after[:REACH]):
            seen: Registration | None = None
            for near, far in pairwise([here, *side]):
                step = self.registration(near, far)
                seen = step if seen is None else seen.then(step)
                vectors, trust = warped_normals(far, seen.fine())
                summed += trust * (vectors - here.vectors)
                weights += trust
        changed: Planes = summed / weights
        return changed

    def smoothed(
        self, here: RegistrationThumbnail, neighbours: Neighbours
    ) -> RegistrationThumbnail:
        """``here`` with its vectors brought to the mean."""
        return replace(here, vectors=here.vectors + self.change(here, neighbours))

    def registration(
        self, here: RegistrationThumbnail, other: RegistrationThumbnail
    ) -> Registration:
        """``other`` seen from ``here``."""
        return registration(here, other, self._between(here, other), self._between(other, here))

    def _between(self, here: RegistrationThumbnail, other: RegistrationThumbnail) -> Planes:
        key = here.name, other.name
        if key not in self._places:
            self._places[key] = places_in(here, other)
            if len(self._places) > _KEPT:
                self._places.popitem(last=False)
        self._places.move_to_end(key)
        return self._places[key]


def warped_normals(
    other: RegistrationThumbnail, seen: Registration
) -> tuple[Planes, NDArray[np.float32]]:
    """The other's normals, brought to where ``seen`` sees them and turned back with the
    drawing, (3, h, w) on the fine grid; and how far to trust them, (h, w)."""
    planes = sampled(np.concatenate([other.vectors, other.inside[None]]), seen.places)
    turn = seen.turn()
    cos, sin = np.cos(turn), np.sin(turn)
    x, y, z, inside = planes
    vectors = np.stack([cos * x + sin * y, cos * y - sin * x, z])
    return vectors, seen.trust * (inside > 0.5)
