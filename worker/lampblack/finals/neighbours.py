"""Loading the neighbours of a shot's drawings, for the temporal filter."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable

from ..drawing import Drawing, decompose_drawing
from ..errors import LampblackError
from ..normals.temporal.neighbours import REACH, NeighbourKeys, neighbour_keys
from ..normals.temporal.temporal_filter import LazyNeighbours, Neighbours
from ..normals.temporal.thumbnail import RegistrationThumbnail
from ..pipeline import Pipeline
from ..shot import Shot, ShotFrame

_KEPT = 4 * REACH
_OPEN = REACH + 1


class NeighbourLoader:
    """Loads the neighbours of a shot's drawings, also those of frames that are not rendered.

    It keeps the last few drawings, and the registration thumbnails of some more. ``check`` is
    called before a drawing is decomposed; an exception from it ends the loading. With a ``reach``
    of 0, drawings have no neighbours.
    """

    def __init__(
        self,
        shot: Shot,
        pipeline: Pipeline,
        reach: int = REACH,
        check: Callable[[], None] = lambda: None,
    ) -> None:
        self._shot = shot
        self._check = check
        self._pipeline = pipeline
        self._frames = {frame.drawing: frame for frame in reversed(shot.frames)}
        self._names = neighbour_keys([frame.drawing for frame in shot.frames], reach)
        self._drawings: OrderedDict[str, Drawing] = OrderedDict()
        self._small: OrderedDict[str, RegistrationThumbnail] = OrderedDict()

    def names(self, frame: ShotFrame) -> NeighbourKeys:
        """The keys of the neighbours of the drawing of ``frame``."""
        return self._names.get(frame.drawing, ((), ()))

    def drawing(self, frame: ShotFrame) -> Drawing:
        """The decomposed drawing of ``frame``.

        Raises:
            DrawingError: it cannot be read, or nothing is drawn on it.
        """
        self._check()
        if frame.drawing not in self._drawings:
            cel = self._shot.cel(frame)
            self._drawings[frame.drawing] = decompose_drawing(
                cel.pixels, mask=cel.mask, ink=cel.ink
            )
            if len(self._drawings) > _OPEN:
                self._drawings.popitem(last=False)
        self._drawings.move_to_end(frame.drawing)
        return self._drawings[frame.drawing]

    def neighbours(self, frame: ShotFrame) -> LazyNeighbours | None:
        """The neighbours of the drawing of ``frame``; None if it has none. On either side they end
        at a drawing that cannot be used."""
        names = self.names(frame)
        return LazyNeighbours(names, lambda: self._around(frame)) if any(names) else None

    def _around(self, frame: ShotFrame) -> Neighbours:
        self._thumbnail(frame.drawing)  # while it is open: the next drawing will ask for it
        return Neighbours(*(tuple(self._usable(side)) for side in self.names(frame)))

    def _usable(self, names: tuple[str, ...]) -> list[RegistrationThumbnail]:
        found: list[RegistrationThumbnail] = []
        for name in names:
            try:
                found.append(self._thumbnail(name))
            except LampblackError:
                break
        return found

    def _thumbnail(self, name: str) -> RegistrationThumbnail:
        if name not in self._small:
            self._small[name] = self._pipeline.thumbnail(self.drawing(self._frames[name]))
            if len(self._small) > _KEPT:
                self._small.popitem(last=False)
        self._small.move_to_end(name)
        return self._small[name]
