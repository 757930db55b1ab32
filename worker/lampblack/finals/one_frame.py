"""A single frame of a shot, with all that is needed to light it."""

from __future__ import annotations

from dataclasses import dataclass

from ..drawing import Drawing
from ..errors import LampblackError
from ..normals.temporal.temporal_filter import LazyNeighbours
from ..pipeline import Pipeline
from ..prepared import PreparedDrawing
from ..scene import Canvas, Hint, Scene
from ..shot import ShotFrame
from ..timeline import scene_at
from .hint_loader import HintLoader
from .neighbours import NeighbourLoader
from .pin_loader import PinLoader
from .resolve import ResolvedShot


@dataclass(frozen=True)
class OneFrame:
    """A drawing with what prepares it, and its scene in the drawing's own pixels."""

    frame: ShotFrame
    drawing: Drawing
    scene: Scene
    neighbours: LazyNeighbours | None
    hints: tuple[Hint, ...]

    def prepare(self, pipeline: Pipeline) -> PreparedDrawing:
        """Prepare it in full detail."""
        return pipeline.prepare(self.drawing, self.neighbours, hints=self.hints)


def first_frame(resolved: ResolvedShot, pipeline: Pipeline) -> OneFrame:
    """Load the first requested frame.

    Raises:
        LampblackError: there is no frame, or its drawing cannot be used.
    """
    if not resolved.frames:
        raise LampblackError("This frame does not exist.", "See which ones the input has.")
    frame = resolved.frames[0]
    neighbour_loader = NeighbourLoader(
        resolved.shot, pipeline, resolved.reach, choices=resolved.overrides.layer_bodies
    )
    drawing = neighbour_loader.drawing(frame)
    canvas = resolved.shot.canvas or Canvas(*drawing.size)
    scene = scene_at(resolved.overrides.scene(canvas), 1 if frame.number is None else frame.number)
    placed = resolved.shot.place(frame, scene, drawing.size)
    placed = PinLoader(resolved.shot, neighbour_loader).followed(frame, placed, scene)
    hints = HintLoader(resolved.shot, neighbour_loader).hints(frame, drawing, scene)
    return OneFrame(frame, drawing, placed, neighbour_loader.neighbours(frame), hints)
