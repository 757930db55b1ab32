"""Loading the neighbours of a shot's drawings, for the temporal filter."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Sequence
from itertools import takewhile

from ..cache import digest
from ..drawing import Body, Drawing, decompose_cel
from ..errors import LampblackError
from ..normals.temporal.neighbours import REACH, NeighbourKeys, neighbour_keys
from ..normals.temporal.temporal_filter import LazyNeighbours, Neighbours
from ..normals.temporal.thumbnail import RegistrationThumbnail
from ..pipeline import Pipeline
from ..scene import LayerBody
from ..shot import Shot, ShotFrame

_KEPT = 16 * REACH
_OPEN = REACH + 1


class NeighbourLoader:
    """Loads the neighbours of a shot's drawings, also those of frames that are not rendered.

    It keeps the last few drawings, and the registration thumbnails of some more. ``check`` is
    called before a drawing is decomposed; an exception from it ends the loading. With a ``reach``
    of 0, drawings have no neighbours. ``choices`` are the artist's, of the bodies of layers.

    A body's neighbours are the bodies of the same layer in the drawing's neighbours. They are named
    by their content, so that a body that only moves keeps its surface.
    """

    def __init__(
        self,
        shot: Shot,
        pipeline: Pipeline,
        reach: int = REACH,
        check: Callable[[], None] = lambda: None,
        choices: Sequence[LayerBody] = (),
    ) -> None:
        self._shot = shot
        self._check = check
        self._pipeline = pipeline
        self._frames = {frame.drawing: frame for frame in reversed(shot.frames)}
        self._names = neighbour_keys([frame.drawing for frame in shot.frames], reach)
        self._drawings: OrderedDict[str, Drawing] = OrderedDict()
        self._small: OrderedDict[str, RegistrationThumbnail] = OrderedDict()
        self._choices = choices
        self._contents: dict[str, dict[str, str]] = {}

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
            self._drawings[frame.drawing] = drawing = decompose_cel(cel, self._choices)
            self._contents[frame.drawing] = {b.name: _content(b) for b in drawing.bodies[::-1]}
            if len(self._drawings) > _OPEN:
                self._drawings.popitem(last=False)
        self._drawings.move_to_end(frame.drawing)
        return self._drawings[frame.drawing]

    def neighbours(self, frame: ShotFrame) -> LazyNeighbours | None:
        """The neighbours of the drawing of ``frame``; None if it has none. On either side they end
        at a drawing that cannot be used."""
        names = self.names(frame)
        if not any(names):
            return None
        return LazyNeighbours(
            names, lambda: self._around(frame), lambda body: self._of_body(frame, body)
        )

    def _around(self, frame: ShotFrame) -> Neighbours:
        self._thumbnail(frame.drawing)  # while it is open: the next drawing will ask for it
        return Neighbours(*(tuple(self._usable(side)) for side in self.names(frame)))

    def _of_body(self, frame: ShotFrame, name: str) -> LazyNeighbours | None:
        """The neighbours of a body; None if it has none, or only copies of itself."""
        here = self._content_of(frame.drawing, name)
        sides = [
            tuple(takewhile(bool, (self._content_of(drawing, name) for drawing in side)))
            for side in self.names(frame)
        ]
        if {*sides[0], *sides[1]} <= {here}:
            return None
        shown = [side[: len(found)] for side, found in zip(self.names(frame), sides, strict=True)]
        return LazyNeighbours(
            (sides[0], sides[1]),
            lambda: Neighbours(*(tuple(self._usable(side, name)) for side in shown)),
        )

    def _content_of(self, drawing: str, name: str) -> str:
        """Names the content of a body of a drawing; empty if there is none."""
        try:
            if drawing not in self._contents:
                self.drawing(self._frames[drawing])
        except LampblackError:
            return ""
        return self._contents[drawing].get(name, "")

    def _usable(self, names: tuple[str, ...], body: str = "") -> list[RegistrationThumbnail]:
        found: list[RegistrationThumbnail] = []
        for name in names:
            try:
                found.append(self._thumbnail(name, body))
            except LampblackError:
                break
        return found

    def _thumbnail(self, name: str, body: str = "") -> RegistrationThumbnail:
        """The thumbnail of a drawing, or of one of its bodies."""
        key = self._contents[name][body] if body else name
        if key not in self._small:
            drawing = self.drawing(self._frames[name])
            if body:
                drawing = next(b.drawing for b in drawing.bodies if b.name == body)
            self._small[key] = self._pipeline.surfaces.thumbnail(drawing)
            if len(self._small) > _KEPT:
                self._small.popitem(last=False)
        self._small.move_to_end(key)
        return self._small[key]


def _content(body: Body) -> str:
    return digest(body.drawing.lines, body.drawing.mask, body.drawing.albedo)
