"""Collects the figures of depth of every method, over drawings with known truth."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import asdict
from functools import partial

from lampblack.errors import LampblackError

from .depth_figures import DepthTruth, mean_known
from .drawings import TestDrawing
from .hollows import mended
from .jumps import Image
from .marks import MARKS, draw_marks, wrongly_cut
from .metrics import measure
from .shadows import ShadowTruth
from .surfaces import (
    MAX_CHARACTER_PX,
    MeasuredSurface,
    Method,
    NetworkMethod,
    Normals,
    surface_by,
    surface_of_height,
    surface_of_normals,
)

TRUE_NORMALS = "true normals"
TRUE_DEPTH = "true depth"
CEILINGS = (TRUE_NORMALS, TRUE_DEPTH)
"""What the best method could reach: the true normals, inflated by the product's solver; and the
true depth as a relief, which lacks only what no viewer sees."""


class DepthMeter:
    """Measures the surfaces of methods, and two ceilings (``CEILINGS``).

    Besides ``DepthFigures`` and ``ShadowFigures`` a row has, for every kind of marks, ``KIND_cut``
    (see ``wrongly_cut``) and ``KIND_rise``, by how many degrees the mean angle to the true normals
    grows with the marks; ``marks_cut`` and ``marks_rise`` are the means of all kinds.

    Args:
        character_px: longest side of the characters.
        marks: measure with marks too, which draws each drawing three times more.
        clicks: measure networks also after one correct click a drawing, in rows of their own; and
            ``mended``, see ``hollows``.

    Raises:
        LampblackError: the characters are so large that their surfaces are made smaller.
    """

    def __init__(self, character_px: int, *, marks: bool = False, clicks: bool = False) -> None:
        if character_px > MAX_CHARACTER_PX:
            raise LampblackError(
                f"Depth cannot be measured on characters of {character_px} pixels.",
                f"Use --resolution {MAX_CHARACTER_PX} or less.",
            )
        self._clicks = clicks
        self._marks = MARKS if marks else ()
        self._found: dict[str, dict[str, list[float]]] = defaultdict(lambda: defaultdict(list))

    def add(
        self, drawing: TestDrawing, methods: dict[str, Method], normals: dict[str, Normals]
    ) -> None:
        """Measure a drawing, with the ``normals`` that each method gave for it."""
        depth = DepthTruth(drawing.depth, drawing.truth)
        shadows = ShadowTruth(
            drawing.vertices, drawing.faces, drawing.truth, drawing.mask, depth.length
        )

        def note(name: str, surface: MeasuredSurface) -> None:
            relief = surface.relief
            self._note(name, asdict(depth.measure(surface.height)))
            self._note(name, asdict(shadows.measure(relief.vertices, relief.faces)))

        for name, method in methods.items():
            surface = surface_by(method, drawing.lines, drawing.mask, normals[name])
            note(name, surface)
            if isinstance(method, NetworkMethod) and self._clicks:
                note(
                    f"{name}, one click",
                    method.corrected(drawing.lines, drawing.mask, drawing.depth),
                )
                told = partial(method, drawing.lines, drawing.mask)
                share = mended(told, normals[name], drawing.truth, drawing.mask)
                self._note(name, {"mended": share})
            if self._marks:
                self._note(name, _with_marks(method, drawing, normals[name], surface.height))
        note(TRUE_NORMALS, surface_of_normals(drawing.truth, drawing.mask))
        note(TRUE_DEPTH, surface_of_height(drawing.depth, drawing.mask))

    def rows(self) -> dict[str, dict[str, float]]:
        """For every method and ceiling, the mean of every figure over the drawings that have it."""
        return {
            name: {figure: mean_known(values) for figure, values in figures.items()}
            for name, figures in self._found.items()
        }

    def _note(self, name: str, figures: dict[str, float]) -> None:
        for figure, value in figures.items():
            self._found[name][figure].append(value)


def _with_marks(
    method: Method, drawing: TestDrawing, normals: Normals, height: Image
) -> dict[str, float]:
    """The figures of marks of one drawing; ``normals`` and ``height`` are those without marks."""
    figures = {}
    for kind in MARKS:
        marked = draw_marks(drawing.lines, drawing.mask, kind)
        found = method(marked.lines, drawing.mask)
        surface = surface_by(method, marked.lines, drawing.mask, found)
        figures[f"{kind}_cut"] = wrongly_cut(marked, surface.height, height, drawing.depth)
        figures[f"{kind}_rise"] = _mean_angle(found, drawing) - _mean_angle(normals, drawing)
    for figure in ("cut", "rise"):
        figures[f"marks_{figure}"] = mean_known([figures[f"{kind}_{figure}"] for kind in MARKS])
    return figures


def _mean_angle(normals: Normals, drawing: TestDrawing) -> float:
    return measure(normals, drawing.truth, drawing.mask).mean
