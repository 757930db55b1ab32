"""The temporal filter: averages the predictions of neighbouring drawings.

Where two drawings show the same thing, their predictions differ only by the network's error, and
the mean of several flickers less than each. The neighbours are registered with the drawing
first. The filter looks equally far back and ahead, so it does not lag. It takes nothing from
places where the drawings differ. Its result does not depend on the order of the calls.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..prediction import Prediction
from .neighbours import REACH, NeighbourKeys
from .registration import Registration, places_in, registration
from .sample import sampled
from .thumbnail import RegistrationThumbnail
from .window import Planes

_KEPT = 16


@dataclass(frozen=True)
class Neighbours:
    """The drawings before and after one, each nearest first; at most ``REACH`` of each count."""

    before: tuple[RegistrationThumbnail, ...] = ()
    after: tuple[RegistrationThumbnail, ...] = ()


@dataclass(frozen=True)
class LazyNeighbours:
    """Neighbours that are loaded only when they are needed. ``keys`` name their contents.
    ``of_body`` finds the neighbours of a body of the drawing, by its layer's name."""

    keys: NeighbourKeys
    load: Callable[[], Neighbours]
    of_body: Callable[[str], LazyNeighbours | None] = lambda name: None


def body_neighbours(neighbours: LazyNeighbours | None, name: str) -> LazyNeighbours | None:
    """The neighbours of a body of a drawing with ``neighbours``; None if it has none."""
    return None if neighbours is None else neighbours.of_body(name)


NO_NEIGHBOURS = Neighbours()


class TemporalFilter:
    """Filters normals, drawing by drawing.

    Caches the last few registrations, since each serves several drawings. The results do not
    depend on the cache.
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
            here: the drawing's thumbnail. neighbours: may have canvases of other sizes.

        Returns:
            (H, W, 3) float32, x right, y up, z to the viewer; unit in the mask, 0 outside.
            Detail finer than the fine grid stays that of the drawing.
        """
        return self.smooth_prediction(Prediction(normals), mask, here, neighbours).normals

    def smooth_prediction(
        self,
        prediction: Prediction,
        mask: NDArray[np.bool_],
        here: RegistrationThumbnail,
        neighbours: Neighbours,
    ) -> Prediction:
        """Average one drawing's prediction with its neighbours': the normals as by ``smooth``, and
        if all thumbnails have them, depth, edge and votes."""
        changed = self._change(here, neighbours)
        correction, place = here.window.to_canvas(changed, mask.shape)
        inside = mask[place]
        moved = prediction.normals[place][inside] + correction[inside][:, :3]
        moved[:, 2] = np.maximum(moved[:, 2], 1e-3)  # what is seen cannot face away
        normals = prediction.normals.copy()
        normals[place][inside] = moved / np.linalg.norm(moved, axis=1, keepdims=True)
        depth, edge = prediction.depth, prediction.edge
        if depth is None or edge is None or here.order is None or len(changed) < 7:
            return Prediction(normals, depth, edge)
        depth, edge = depth.copy(), edge.copy()
        depth[place][inside] += correction[inside][:, 5]
        edge[place][inside] += correction[inside][:, 6]
        votes = np.zeros((*mask.shape, 2), np.float32)
        counted, _ = here.window.to_canvas(here.order[:2] + changed[3:5], mask.shape)
        votes[place] = counted * inside[..., None]
        return Prediction(normals, depth, edge, votes)

    def change(self, here: RegistrationThumbnail, neighbours: Neighbours) -> Planes:
        """(3, h, w) float32: the mean minus ``here.vectors``, on the fine grid."""
        return self._change(here, neighbours)[:3]

    def _change(self, here: RegistrationThumbnail, neighbours: Neighbours) -> Planes:
        """``change``, and if all have it that of ``order``: (7, h, w)."""
        everyone = (here, *neighbours.before[:REACH], *neighbours.after[:REACH])
        ordered = all(drawing.order is not None for drawing in everyone)
        mine = _planes(here, ordered)
        summed = np.zeros_like(mine)
        weights = np.ones(here.inside.shape, np.float32)
        for side in (neighbours.before[:REACH], neighbours.after[:REACH]):
            seen: Registration | None = None
            for near, far in pairwise([here, *side]):
                step = self.registration(near, far)
                seen = step if seen is None else seen.then(step)
                planes, trust = _warped(far, seen.fine(), ordered)
                change = planes - mine
                # Depths are known but for a constant.
                change[5:6] -= (trust * change[5:6]).sum() / max(float(trust.sum()), 1e-6)
                summed += trust * change
                weights += trust
        changed: Planes = summed / weights
        return changed

    def smoothed(
        self, here: RegistrationThumbnail, neighbours: Neighbours
    ) -> RegistrationThumbnail:
        """``here`` with the mean as its vectors."""
        return replace(here, vectors=here.vectors + self.change(here, neighbours))

    def registration(
        self, here: RegistrationThumbnail, other: RegistrationThumbnail
    ) -> Registration:
        """The registration of ``here`` with ``other``."""
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
    """The other drawing's normals, warped by the registration ``seen`` and rotated back with it,
    (3, h, w) on the fine grid; and their trust, (h, w)."""
    return _warped(other, seen, False)


def _warped(
    other: RegistrationThumbnail, seen: Registration, ordered: bool
) -> tuple[Planes, NDArray[np.float32]]:
    """``warped_normals``, and if ``ordered`` the other's order below them: (7, h, w)."""
    planes = sampled(np.concatenate([other.inside[None], _planes(other, ordered)]), seen.places)
    turn = seen.turn()
    cos, sin = np.cos(turn), np.sin(turn)
    inside, x, y, z, *order = planes
    if ordered:
        across, up, *_ = order
        order[:2] = cos * across + sin * up, cos * up - sin * across
    warped = np.stack([cos * x + sin * y, cos * y - sin * x, z, *order])
    return warped, seen.trust * (inside > 0.5)


def _planes(drawing: RegistrationThumbnail, ordered: bool) -> Planes:
    if not ordered or drawing.order is None:
        return drawing.vectors
    return np.concatenate([drawing.vectors, drawing.order])
