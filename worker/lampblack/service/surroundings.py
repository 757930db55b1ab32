"""The drawings beside each one of a job, so that its normals hold still over time."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable

from ..drawing import DrawingPlanes
from ..errors import LampblackError
from ..normals.temporal.neighbours import REACH, NeighbourKeys
from ..normals.temporal.temporal_filter import LazyNeighbours, Neighbours
from ..normals.temporal.thumbnail import RegistrationThumbnail
from ..pipeline import Pipeline

FindPlanes = Callable[[str], DrawingPlanes]

_KEPT = 4 * REACH


class Surroundings:
    """Finds neighbours by digest; the last few are kept in miniature."""

    def __init__(self, pipeline: Pipeline) -> None:
        self._pipeline = pipeline
        self._small: OrderedDict[str, RegistrationThumbnail] = OrderedDict()

    def neighbours(self, names: NeighbourKeys, planes: FindPlanes) -> LazyNeighbours | None:
        """The neighbours called ``names``, None if there are none; of those before and after,
        none beyond one that cannot be used. ``planes`` finds a drawing by its digest."""
        if not any(names):
            return None
        return LazyNeighbours(
            names, lambda: Neighbours(*(tuple(self._usable(n, planes)) for n in names))
        )

    def _usable(self, names: tuple[str, ...], planes: FindPlanes) -> list[RegistrationThumbnail]:
        found: list[RegistrationThumbnail] = []
        for name in names:
            try:
                found.append(self._thumbnail(name, planes))
            except LampblackError:
                break
        return found

    def _thumbnail(self, name: str, planes: FindPlanes) -> RegistrationThumbnail:
        if name not in self._small:
            self._small[name] = self._pipeline.thumbnail(planes(name).decompose())
            if len(self._small) > _KEPT:
                self._small.popitem(last=False)
        self._small.move_to_end(name)
        return self._small[name]
