"""Pinned lights in the frames of a shot."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from ..drawing import Drawing
from ..errors import LampblackError
from ..normals.temporal.temporal_filter import TemporalFilter
from ..pins import Offset, carried_place, followed, pins_of
from ..scene import AreaLight, Pin, Scene
from ..shot import Shot, ShotFrame, by_number
from .neighbours import NeighbourLoader


@dataclass
class PinLoader:
    """Finds where pinned lights are in drawings of ``shot``, which ``neighbours`` decomposes.

    A frame without a number is counted by its position in the shot.
    """

    shot: Shot
    neighbours: NeighbourLoader
    _temporal_filter: TemporalFilter = field(default_factory=TemporalFilter)

    def __post_init__(self) -> None:
        self._numbers = by_number(self.shot.frames)
        self._found: dict[tuple[Pin, str], Offset | None] = {}

    def followed(self, frame: ShotFrame, placed: Scene, scene: Scene) -> Scene:
        """``placed``, the scene in pixels of the cel of ``frame``, with its lamps where their pins
        have moved; ``scene`` is on the canvas. A drawing that cannot be read moves nothing."""
        offsets: dict[Pin, Offset] = {}
        for pin in pins_of(scene):
            source = self._numbers.get(pin.frame)
            if source is None or source.drawing == frame.drawing:
                continue
            key = pin, frame.drawing
            if key not in self._found:
                try:
                    self._found[key] = self._offset(pin, source, frame, scene)
                except LampblackError:
                    self._found[key] = None
            if (offset := self._found[key]) is not None:
                offsets[pin] = offset
        return followed(placed, offsets)

    def names(self, scene: Scene) -> tuple[str, ...]:
        """The drawings on which lights are pinned."""
        frames = (self._numbers.get(pin.frame) for pin in pins_of(scene))
        return tuple(frame.drawing for frame in frames if frame is not None)

    def _offset(self, pin: Pin, source: ShotFrame, frame: ShotFrame, scene: Scene) -> Offset | None:
        made_on, here = self.neighbours.drawing(source), self.neighbours.drawing(frame)
        found = carried_place(
            self._seen(pin, source, made_on, scene), pin.layer, made_on, here,
            self._temporal_filter,
        )  # fmt: skip
        if found is None:
            return None
        still = self._seen(pin, frame, here, scene)
        return found[0] - still[0], found[1] - still[1]

    def _seen(self, pin: Pin, frame: ShotFrame, drawing: Drawing, scene: Scene) -> Offset:
        """The pinned place of the canvas, in pixels of ``drawing``."""
        alone = replace(scene, lights=(AreaLight(pin.x, pin.y, 0),), rim=None)
        (light,) = self.shot.place(frame, alone, drawing.size).lights
        return light.x, light.y
