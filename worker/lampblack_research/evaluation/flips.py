"""Measures how often cuts of a surface change from drawing to drawing: shadows that pop."""

from __future__ import annotations

from collections.abc import Callable
from math import nan
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import KDTree

from .jumps import STEP, Image, Pairs, figure_length, jump_pairs, links_as_pairs

SHORTEST = 0.02
"""Length of the shortest cut that is followed, as a share of the figure's length."""
NEAR = 0.015
"""Distance from where a cut is expected, within which it is found again; share of the length."""

Points = NDArray[np.float32]
Carry = Callable[[Points], Points | None]
"""Where (N, 2) points of one drawing, x right and y down in pixels, lie in another; nan or None
where that is not known."""


class Flips(NamedTuple):
    """How steady cuts are.

    Attributes:
        cuts: number of cuts that two consecutive drawings have, together and where one can be
            followed to the other; mean.
        swaps: of 100 such cuts, how many have the other side in front in the next drawing.
        flips: of 100 such cuts, how many swap, vanish or appear. Where every frame is a new drawing
            these are the flips per cut in 100 frames.
    """

    cuts: float
    swaps: float
    flips: float


class Cuts:
    """The cuts of one height map.

    A cut is a connected row of jump pairs (``jump_pairs``), 2 % of the figure's length or longer.
    It counts as found again where the height jumps by half as much as a new cut needs, so
    that a jump at the threshold does not flip.

    Args:
        height: (H, W) float32, pixels of the drawing towards the viewer, nan outside.
    """

    def __init__(self, height: Image) -> None:
        self.length = figure_length(np.isfinite(height))
        pairs, _ = jump_pairs(height, self.length)
        self.strokes = self._strokes(pairs, height.shape)
        self._all = links_as_pairs(height, STEP, self.length)
        middles = np.column_stack([self._all.row, self._all.column])
        self._tree = KDTree(middles) if len(middles) else None

    def _strokes(self, pairs: Pairs, shape: tuple[int, ...]) -> list[Pairs]:
        at = tuple(np.round(x).astype(int) for x in (pairs.row, pairs.column))
        drawn = np.zeros(shape, bool)
        drawn[at] = True
        # Pixels of one diagonal edge may leave a gap.
        joined, _ = ndimage.label(ndimage.binary_dilation(drawn, np.ones((3, 3))), np.ones((3, 3)))
        which = joined[at]
        found = [pairs.only(which == label) for label in np.unique(which)]
        return [
            stroke
            for stroke in found
            if max(np.ptp(stroke.row), np.ptp(stroke.column)) >= SHORTEST * self.length
        ]

    def fate(self, stroke: Pairs, carry: Carry) -> Literal["kept", "swapped", "gone"] | None:
        """What became of a cut of another drawing, most of its length deciding; None if ``carry``
        does not know most of it. The nearer side is followed: an outline is its own."""
        row, column = stroke.along(stroke.reach)
        carried = carry(np.column_stack([column + 0.5, row + 0.5]).astype(np.float32))
        if carried is None:
            return None
        known = np.isfinite(carried).all(axis=1)
        if known.mean() < 0.5:
            return None
        beside = stroke.only(known)
        across = np.column_stack([beside.down, beside.right])
        middles = carried[known, ::-1] - 0.5 - stroke.reach * across
        kept, found = np.zeros(len(middles), bool), np.zeros(len(middles), bool)
        if self._tree is not None:
            near = self._tree.query_ball_point(middles, NEAR * self.length)
            for index, candidates in enumerate(near):
                found[index] = bool(candidates)
                same = across[index, 0] * self._all.down[candidates]
                same += across[index, 1] * self._all.right[candidates]
                kept[index] = (same > 0).any()
        if kept.mean() >= 0.5:
            return "kept"
        return "swapped" if (found & ~kept).sum() > (~found).sum() else "gone"


class FlipMeter:
    """Measures distinct drawings in order."""

    def __init__(self) -> None:
        self._last: Cuts | None = None
        self._pairs, self._followed, self._swapped, self._flipped = 0, 0, 0, 0

    def add(self, height: Image, ahead: Carry | None, back: Carry | None) -> None:
        """Add the next drawing.

        Args:
            height: see ``Cuts``.
            ahead: carries points of the last drawing to this one. back: the other way.
        """
        here, last = Cuts(height), self._last
        self._last = here
        if last is None or ahead is None or back is None:
            return
        later = [here.fate(stroke, ahead) for stroke in last.strokes]
        earlier = [last.fate(stroke, back) for stroke in here.strokes]
        self._pairs += 1
        self._followed += sum(fate is not None for fate in later) + earlier.count("gone")
        self._swapped += later.count("swapped")
        self._flipped += later.count("swapped") + later.count("gone") + earlier.count("gone")

    @property
    def flips(self) -> Flips:
        """The figures of all drawings so far; nan without drawings, or without cuts."""
        if not self._pairs:
            return Flips(nan, nan, nan)
        cuts = self._followed / self._pairs
        if not cuts:
            return Flips(0.0, nan, nan)
        swaps, flips = (100 * n / self._followed for n in (self._swapped, self._flipped))
        return Flips(cuts, swaps, flips)
