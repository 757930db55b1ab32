"""Where the strokes of a drawing are occlusions, and which side of them is in front.

A part that overlaps another ends at a line of ink, and behind that line the surface goes on
further back. The network predicts where that happens and, roughly, the depth on either side. Both
are blurred, so they are read beside the strokes, and averaged along them. Colour borders, patches,
stripes, folds and hatching are strokes too: where unsure, the two sides stay joined.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..choices import FrontSide
from ..compiled import compiled
from .cuts import Floats, across
from .repeats import Repeats, repeats_among
from .strokes import Stroke, mean_along

EDGE = 0.45
"""A stroke is an occlusion where the network is this sure of one (best F1 on test views)."""
EDGE_GOES_ON = 0.3
"""An occlusion found nearby goes on along its stroke where the network is this sure."""
SURE = {Repeats.ALONE: 0.43, Repeats.BESIDE: 0.57, Repeats.REPEATED: 0.7}
"""The least that it is sure on average over an occlusion: it half believes in marks, which repeat
(chosen on validation views)."""
STEP = 0.012
"""Step of the order across a stroke from which on it is an occlusion, as a share of the character's
length; at lower ones, borders of colours are cut."""
STEP_GOES_ON = 0.006
"""The same where an occlusion goes on."""
SHORTEST = 0.03
"""Length of the shortest occlusion; share of the character's length."""
SHORTEST_FREE = 0.1
"""The same on strokes that are free at both ends, such as those of hatching and folds."""
MAJORITY, MINORITY = 0.5, 0.25
"""Share of the votes from which on an occlusion is one, and goes on."""
WIDER = 2.0
"""Ink wider than this multiple of the drawing's usual line is no line, but a texture or a filled
shape."""
STEADY = 0.85
"""Length of the mean of a stroke's unit directions over ``STEADY_OVER`` either way, at least:
rough textures turn more."""
STEADY_OVER = 0.02
BESIDE = (0.008, 0.02)
"""How far beside the ink its two sides are compared; shares of the length."""
POOL = 0.02
"""Steps are averaged over this share of the length, either way along a stroke."""
WIDEST = 0.02
"""Half the width of the widest line; share of the length."""
CLOSE = 0.02
"""An occlusion that ends this near to a junction or to the outline reaches it; share of the
length."""


@dataclass(frozen=True, eq=False)
class Occlusion:
    """A part of a stroke where one side is in front.

    Attributes:
        points: (N, 2) float32 x, y in pixels of the grid, about one pixel apart.
        front: the side in front, walking along the points; "joined" only if a hint says so.
        open_ends: whether the two sides join beyond the first point, and beyond the last.
        hinted: the artist said so.
        amount: the step, as a share of the character's length; 0 where it is found.
    """

    points: Floats
    front: FrontSide
    open_ends: tuple[bool, bool]
    hinted: bool = False
    amount: float = 0.0

    @property
    def towards(self) -> Floats:
        """(N, 2) float32 x, y, unit: across the line, to the side in front."""
        return across(self.points, self.front)


def find_occlusions(
    strokes: list[Stroke],
    ink: NDArray[np.bool_],
    order: Floats,
    edge: Floats,
    mask: NDArray[np.bool_],
    length: float,
    votes: Floats | None = None,
) -> list[Occlusion]:
    """The parts of ``strokes`` that are occlusions.

    Args:
        strokes: those of ``ink``, (H, W) bool.
        order: (H, W) float32 pixels; what is nearer is higher.
        edge: (H, W) float32, 0 to 1, how likely an occlusion is near.
        mask: (H, W) bool, the character. length: of the character, in pixels.
        votes: (H, W, 2) float32, as of ``Prediction``: they decide, instead of what is found in
            this drawing alone.
    """
    found: list[Occlusion] = []
    reach, far = max(1, round(POOL * length)), max(1, round(STEADY_OVER * length))
    beside = np.array(BESIDE, np.float32) * np.float32(length)
    widest = np.float32(WIDEST * length)
    long = [stroke for stroke in strokes if len(stroke.points) >= SHORTEST * length]
    repeats = repeats_among(long, mask.shape, length)
    sides = [across(stroke.points, "left") for stroke in long]
    compared = [
        _compare(stroke.points, left, ink, order, edge, mask, beside, widest)
        for stroke, left in zip(long, sides, strict=True)
    ]
    widths = [width for _, _, _, width in compared]
    usual = float(np.median(np.concatenate(widths))) if widths else 0.0
    for stroke, left, repeat, (step, sure, known, width) in zip(
        long, sides, repeats, compared, strict=True
    ):
        step, sure = (mean_along(a, known, reach, closed=stroke.closed) for a in (step, sure))
        every = np.ones(len(known), bool)
        mean_left = [mean_along(a, every, far, closed=stroke.closed) for a in left.T]
        broad = mean_along(width, every, reach, closed=stroke.closed) > WIDER * usual + 1
        clear = known & (sure > EDGE) & (np.hypot(*mean_left) > STEADY) & ~broad
        faint = sure > EDGE_GOES_ON
        share = step / np.float32(length)
        if votes is not None:
            share, clear, faint = _voted(stroke, left, votes, reach)
            clear &= known
        both: tuple[tuple[FrontSide, Floats], ...] = ("left", share), ("right", -share)
        for front, ahead in both:
            start, goes_on = clear & (ahead > STEP), faint & (ahead > STEP_GOES_ON)
            found += [
                run
                for run, sureness in _runs(stroke, start, goes_on, known, front, length, sure)
                if votes is not None or sureness > SURE[repeat]
            ]
    return [_to_the_outline(occlusion, mask, length) for occlusion in found]


def _voted(
    stroke: Stroke, left: Floats, votes: Floats, reach: int
) -> tuple[Floats, NDArray[np.bool_], NDArray[np.bool_]]:
    """The vote for the left side at each point, at the scale of ``STEP``, and where a majority and
    a minority are for either side."""
    x, y = np.floor(stroke.points).astype(int).T
    row, column = np.clip(y, 0, votes.shape[0] - 1), np.clip(x, 0, votes.shape[1] - 1)
    across_left, up_left = left[:, 0], -left[:, 1]
    count = votes[row, column, 0] * across_left + votes[row, column, 1] * up_left
    every = np.ones(len(count), bool)
    count = mean_along(count, every, reach, closed=stroke.closed)
    return np.sign(count), np.abs(count) > MAJORITY, np.abs(count) > MINORITY


def _to_the_outline(occlusion: Occlusion, mask: NDArray[np.bool_], length: float) -> Occlusion:
    """The occlusion, extended through the outline's own ink where it ends there."""
    points = occlusion.points
    for end in (0, 1):
        line = points if end else points[::-1]
        if occlusion.open_ends[end] or len(line) < 2:
            continue
        back = line[-1 - min(len(line) - 1, 8)]
        ahead = (line[-1] - back) / max(float(np.hypot(*(line[-1] - back))), 1e-6)
        ray = line[-1] + np.arange(1, 2 * WIDEST * length + 2, dtype=np.float32)[:, None] * ahead
        x, y = np.floor(ray).astype(int).T
        seen = (x >= 0) & (y >= 0) & (x < mask.shape[1]) & (y < mask.shape[0])
        inside = seen & mask[np.where(seen, y, 0), np.where(seen, x, 0)]
        if not inside.all():
            line = np.concatenate([line, ray[: int(np.argmin(inside)) + 1]])
            points = line if end else line[::-1]
    return replace(occlusion, points=points)


def _runs(
    stroke: Stroke,
    start: NDArray[np.bool_],
    goes_on: NDArray[np.bool_],
    known: NDArray[np.bool_],
    front: FrontSide,
    length: float,
    sure: Floats,
) -> list[tuple[Occlusion, float]]:
    """The parts of a stroke that go on, where enough of each is a start; and how sure each is."""
    points, count = stroke.points, len(goes_on)
    if stroke.closed and not goes_on.all():
        first = -int(np.argmin(goes_on))  # start where nothing is found
        points = np.roll(points, first, axis=0)
        start, goes_on, known = (np.roll(a, first) for a in (start, goes_on, known))
        sure = np.roll(sure, first)
    close = round(CLOSE * length)
    free = not any(stroke.meets) and not stroke.closed
    shortest = (SHORTEST_FREE if free else SHORTEST) * length
    changes = np.flatnonzero(np.diff(np.concatenate([[False], goes_on, [False]])))
    found = []
    for first, last in changes.reshape(-1, 2):
        if last - first < shortest or np.count_nonzero(start[first:last]) < SHORTEST * length / 2:
            continue
        if stroke.closed and last - first == count:
            ring = Occlusion(np.concatenate([points, points[:1]]), front, (False, False))
            found.append((ring, float(sure.mean())))
            continue
        sureness = float(sure[first:last].mean())
        if stroke.meets[0] and first <= close:
            first = 0
        if stroke.meets[1] and count - last <= close:
            last = count
        # Beyond the outline of the character nothing is known.
        joins_first = first > 0 or not stroke.meets[0]
        joins_last = last < count or not stroke.meets[1]
        joins_first &= bool(known[max(0, first - close) : first].all())
        joins_last &= bool(known[last : last + close].all())
        run = Occlusion(points[first:last], front, (joins_first, joins_last))
        found.append((run, sureness))
    return found


@compiled
def _compare(
    points: Floats,
    left: Floats,
    ink: NDArray[np.bool_],
    order: Floats,
    edge: Floats,
    mask: NDArray[np.bool_],
    beside: Floats,
    widest: np.float32,
) -> tuple[Floats, Floats, NDArray[np.bool_], Floats]:
    """At each point of a stroke: the order on the left minus that on the right, both beyond the
    ink; the largest edge on it and beside it; whether both sides are inside the character; the
    width of the ink."""
    count = len(points)
    step, sure = np.zeros(count, np.float32), np.zeros(count, np.float32)
    known, width = np.zeros(count, np.bool_), np.zeros(count, np.float32)
    rows, columns = mask.shape
    for i in range(count):
        sides = np.zeros(2, np.float32)
        seen = np.zeros(2, np.int32)
        for s in range(2):
            x, y = left[i, 0] * (1 - 2 * s), left[i, 1] * (1 - 2 * s)
            out = np.float32(0)
            while out < widest:
                r, c = int(np.floor(points[i, 1] + out * y)), int(np.floor(points[i, 0] + out * x))
                if r < 0 or c < 0 or r >= rows or c >= columns or not ink[r, c]:
                    break
                out += np.float32(0.5)
            width[i] += out
            for more in beside:
                r = int(np.floor(points[i, 1] + (out + more) * y))
                c = int(np.floor(points[i, 0] + (out + more) * x))
                if r < 0 or c < 0 or r >= rows or c >= columns or not mask[r, c]:
                    break
                if seen[s] == 0:
                    sure[i] = max(sure[i], edge[r, c])
                elif ink[r, c]:
                    break
                sides[s] += order[r, c]
                seen[s] += 1
        r = min(max(int(np.floor(points[i, 1])), 0), rows - 1)
        c = min(max(int(np.floor(points[i, 0])), 0), columns - 1)
        sure[i] = max(sure[i], edge[r, c])
        known[i] = seen[0] > 0 and seen[1] > 0
        if known[i]:
            step[i] = sides[0] / np.float32(seen[0]) - sides[1] / np.float32(seen[1])
    return step, sure, known, width
