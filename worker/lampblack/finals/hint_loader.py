"""Loading the hints of depth that count for a frame of a shot."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from ..drawing import Drawing
from ..errors import LampblackError
from ..hints import HintedDrawing, carry_hints, hint_frames
from ..normals.temporal.temporal_filter import TemporalFilter
from ..scene import Hint, Scene
from ..shot import Shot, ShotFrame, by_number
from .neighbours import NeighbourLoader


@dataclass
class HintLoader:
    """Finds the hints for drawings of ``shot``, which ``neighbours`` decomposes.

    A frame without a number is counted by its position in the shot.
    """

    shot: Shot
    neighbours: NeighbourLoader
    _temporal_filter: TemporalFilter = field(default_factory=TemporalFilter)

    def __post_init__(self) -> None:
        self._numbers = by_number(self.shot.frames)
        self._first: dict[str, int] = {}
        for number, frame in self._numbers.items():
            self._first[frame.drawing] = min(number, self._first.get(frame.drawing, number))

    def hints(self, frame: ShotFrame, drawing: Drawing, scene: Scene) -> tuple[Hint, ...]:
        """The hints for ``frame``, in pixels of ``drawing``; ``scene`` is on the canvas."""
        if not scene.depth.drawn:
            return scene.depth.colours
        hinted = self._hinted(frame, drawing, scene)
        return *carry_hints(hinted, drawing, self._temporal_filter), *scene.depth.colours

    def names(self, frame: ShotFrame, scene: Scene) -> tuple[str, ...]:
        """The drawings on which these hints were made."""
        return tuple(source.drawing for _, source in self._sources(frame, scene))

    def _sources(self, frame: ShotFrame, scene: Scene) -> list[tuple[int, ShotFrame]]:
        """The same for all frames that show one drawing, since it is lit once."""
        numbers = hint_frames(scene.depth, self._first.get(frame.drawing, 0))
        return [(n, self._numbers[n]) for n in numbers if n in self._numbers]

    def _hinted(self, frame: ShotFrame, drawing: Drawing, scene: Scene) -> Iterator[HintedDrawing]:
        """Drawings that cannot be read have no say."""
        for number, source in self._sources(frame, scene):
            try:
                same = source.drawing == frame.drawing
                made_on = drawing if same else self.neighbours.drawing(source)
                placed = self.shot.place(source, scene, made_on.size)
            except LampblackError:
                continue
            hints = tuple(hint for hint in placed.depth.drawn if hint.frame == number)
            yield HintedDrawing(made_on, hints)
