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
