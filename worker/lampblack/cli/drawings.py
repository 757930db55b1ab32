"""The drawings of a shot, one after another, for commands that use each of them."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

import typer

from ..errors import DrawingError, LampblackWarning, NothingDrawnError
from .console import EXIT_FAILED, print_error, progress_bar

if TYPE_CHECKING:
    from ..drawing import Drawing
    from ..finals.resolve import ResolvedShot
    from ..pipeline import Pipeline
    from ..prepared import PreparedDrawing
    from ..shot import ShotFrame

    Frames = Sequence[ShotFrame]


def each_drawing(
    resolved: ResolvedShot,
    groups: Sequence[Frames],
    doing: str,
    read: Callable[[ShotFrame], Drawing] | None = None,
) -> Iterator[tuple[Frames, Drawing]]:
    """Each group of frames that show one drawing, with the result of ``read`` for it. Without
    ``read``, the drawing is decomposed.

    A blank drawing is skipped with a warning. A drawing that cannot be read is reported and
    skipped, and the command fails at the end. Both are errors if the shot is a single drawing.
    """
    from ..drawing import decompose_drawing

    def find(frame: ShotFrame) -> Drawing:
        cel = resolved.shot.cel(frame)
        return decompose_drawing(cel.pixels, mask=cel.mask, ink=cel.ink)

    failed = False
    with progress_bar() as bar:
        for frames in bar.track(groups, description=doing):
            name = frames[0].name
            try:
                drawing = (read or find)(frames[0])
            except DrawingError as error:
                if resolved.single:
                    raise
                if isinstance(error, NothingDrawnError):
                    warnings.warn(f"{name}: {error.what}", LampblackWarning, stacklevel=2)
                else:
                    print_error(error, f"{name}: ")
                    failed = True
                continue
            yield frames, drawing
    if failed:
        raise typer.Exit(EXIT_FAILED)


def each_prepared(
    resolved: ResolvedShot, pipeline: Pipeline, doing: str
) -> Iterator[tuple[Frames, PreparedDrawing]]:
    """Each group of frames that show one drawing, with the drawing prepared in full detail: with
    its neighbours, and with the hints of the scene."""
    from ..finals.hint_loader import HintLoader
    from ..finals.neighbours import NeighbourLoader
    from ..scene import Canvas
    from ..shot import by_drawing

    shot, overrides = resolved.shot, resolved.overrides
    around = NeighbourLoader(shot, pipeline, resolved.reach, choices=overrides.layer_bodies)
    loader = HintLoader(shot, around)
    groups = by_drawing(resolved.frames)
    for frames, drawing in each_drawing(resolved, groups, doing, around.drawing):
        scene = overrides.scene(shot.canvas or Canvas(*drawing.size))
        hints = loader.hints(frames[0], drawing, scene)
        yield frames, pipeline.prepare(drawing, around.neighbours(frames[0]), hints=hints)
