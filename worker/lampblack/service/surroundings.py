"""The drawings beside each one of a job, so that its normals hold still over time."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable

from ..errors import LampblackError
from ..normals.temporal.miniature import Miniature
from ..normals.temporal.neighbours import Names
from ..normals.temporal.steady import REACH, Around, Beside
from ..pipeline import Pipeline
from .model import Planes, take_planes_apart

_KEPT = 4 * REACH


class Surroundings:
    """Finds neighbours by digest; the last few are kept in miniature."""

    def __init__(self, pipeline: Pipeline) -> None:
        self._pipeline = pipeline
        self._small: OrderedDict[str, Miniature] = OrderedDict()

    def beside(self, names: Names, planes: Callable[[str], Planes]) -> Beside | None:
        """The neighbours called ``names``, None if there are none; of those before and after,
        none beyond one that cannot be used. ``planes`` finds a drawing by its digest."""
        if not any(names):
            return None
        return Beside(names, lambda: Around(*(tuple(self._usable(n, planes)) for n in names)))

    def _usable(self, names: tuple[str, ...], planes: Callable[[str], Planes]) -> list[Miniature]:
        found: list[Miniature] = []
        for name in names:
            try:
                found.append(self._miniature(name, planes))
            except LampblackError:
                break
        return found

    def _miniature(self, name: str, planes: Callable[[str], Planes]) -> Miniature:
        if name not in self._small:
            self._small[name] = self._pipeline.miniature(take_planes_apart(planes(name)))
            if len(self._small) > _KEPT:
                self._small.popitem(last=False)
        self._small.move_to_end(name)
        return self._small[name]
