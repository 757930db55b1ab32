"""Inflation of a character whose parts overlap: a surface with steps.

In two solves. A small surface, cut at the occlusions and held by the predicted depth alone, tells
how far the parts lie apart; of it only these steps are kept. Then the whole surface is inflated
from its normals with the steps, so that all its slopes stay those of the normals.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..normals.prediction import Prediction
from ..scene import DepthHint, DepthPoint
from .corrections import Corrections
from .cuts import Cuts, Floats, across, jumps_across
from .direct import Prior, inflate_direct
from .hinted import apply_hints
from .occlusions import Occlusion, find_occlusions
from .overlap import Overlap
from .solver import rest_on_border, solve, usable_normals
from .strokes import Stroke, find_strokes, mean_along

SMALL_PX = 500
"""Longest side, about, of a character where only steps are wanted."""
INK = 0.3
"""Least darkness of a line that separates parts."""
PRIOR = 10.0
"""The weight of the predicted depth is the square of this over the character's length: shapes
smaller than a tenth of the character follow the normals. At 5, steps are lost; at 20, the surface
bends."""
ORDER_BY_DEPTH = 2.0
"""What is in front is decided by the predicted depth times this, plus the height of the normals."""
GAIN = 1.5
"""Steps held by the predicted depth are too small by about this factor; at 2, more of them are
too large."""
LEAST, LARGEST = 0.05, 0.3
"""Limits of a step; shares of the length."""
TAPER = 0.04
"""A step falls to 0 over this distance from an end where its sides join; share of the length."""
POOL = 0.01
"""Steps are averaged over this share of the length, either way along an occlusion."""
VOTES_REACH = 0.012
"""A drawing votes this far around its overlaps, since those of others lie a little beside; share of
the length."""
ROUGH = 1e-2
"""Tolerance of the solver where only steps are wanted."""


def dividing_lines(
    lines: NDArray[np.float32], ink: NDArray[np.float32], mask: NDArray[np.bool_]
) -> NDArray[np.float32]:
    """(H, W) float32, 0 to 1: the lines at which a part may end. In an inked drawing they are ink;
    in one without, the borders of its colours.

    Args:
        lines, ink: (H, W) float32 in 0..1. mask: (H, W) bool.
    """
    outline = mask & ~ndimage.binary_erosion(mask)
    inked = bool((ink[outline] > INK).sum() * 2 > np.count_nonzero(outline))
    chosen: NDArray[np.float32] = np.where(mask, ink if inked else lines, np.float32(0))
    return chosen


def solve_with_overlaps(
    prediction: Prediction,
    mask: NDArray[np.bool_],
    lines: NDArray[np.float32],
    hints: Sequence[DepthHint] = (),
    corrections: Corrections | None = None,
) -> tuple[NDArray[np.float32], list[Overlap]]:
    """Inflate a prediction, with steps where parts overlap.

    Args:
        prediction: of (H, W). Without depth, the surface has no steps but those of hints.
        mask: (H, W) bool, True inside the character.
        lines: (H, W) float32 in 0..1, the lines at which a part may end.
        hints: what the artist says, in pixels of (H, W), whatever their frames. Each wins over
            what was found where it is drawn: see ``apply_hints``. Of two that say something about
            one place, the last counts.
        corrections: of the surface, which leave its steps where they are.

    Returns:
        (H, W) float32 height as from ``solve``, corrected, and the overlaps along which it steps,
        the longest first.

    Raises:
        ValueError: the shapes do not fit.
    """
    depth, edge = prediction.depth, prediction.edge
    corrections = corrections or Corrections()
    alone = (depth is None or edge is None) and not hints
    if not mask.any() or (alone and not corrections):
        return solve(prediction.normals, mask), []
    normals = usable_normals(prediction.normals, mask)
    cuts, overlaps = Cuts.none(mask.shape), []
    small = _small_of(prediction, mask, lines)
    for occlusion, small_steps in [] if alone else _steps(small, hints):
        points, steps = small.on_canvas(occlusion.points), small_steps * small.by
        if occlusion.front != "joined":
            cuts.add(points, across(points, occlusion.front), steps, mask)
        overlaps.append(Overlap(points, occlusion.front, float(steps.mean()), occlusion.hinted))
    overlaps.sort(key=lambda overlap: len(overlap.points), reverse=True)
    normals = corrections.normals(normals, mask)
    height = inflate_direct(normals, mask, cuts if overlaps else None)
    return corrections.height(rest_on_border(height, mask), mask, cuts), overlaps


def overlap_votes(
    prediction: Prediction, mask: NDArray[np.bool_], lines: NDArray[np.float32]
) -> NDArray[np.float32]:
    """(H, W, 2) float32, what a drawing votes for: see ``Prediction``. Arguments as for
    ``solve_with_overlaps``."""
    votes = np.zeros((*mask.shape, 2), np.float32)
    if prediction.depth is None or prediction.edge is None or not mask.any():
        return votes
    small = _small_of(replace(prediction, votes=None), mask, lines)
    found, _ = _occlusions(small)
    if not found:
        return votes
    points = np.concatenate([occlusion.points for occlusion in found])
    towards = np.concatenate([occlusion.towards for occlusion in found])
    column, row = np.floor(points).astype(int).T
    drawn = np.zeros((*small.mask.shape, 2), np.float32)
    seen = (row >= 0) & (column >= 0) & (row < drawn.shape[0]) & (column < drawn.shape[1])
    drawn[row[seen], column[seen]] = towards[seen] * np.array([1, -1], np.float32)
    distance, nearest = ndimage.distance_transform_edt(~drawn.any(axis=2), return_indices=True)
    drawn = drawn[tuple(nearest)] * (distance <= VOTES_REACH * small.length)[..., None]
    whole = drawn.repeat(small.by, axis=0).repeat(small.by, axis=1)
    top, left = small.corner
    area = votes[top : top + whole.shape[0], left : left + whole.shape[1]]
    area[:] = whole[: area.shape[0], : area.shape[1]]
    return votes * mask[..., None]


@dataclass(frozen=True, eq=False)
class _Small:
    """A character at reduced size: its pixels are blocks of ``by`` x ``by`` from ``corner`` (row,
    column) on. Heights are in its own pixels. ``length`` is the longer side of its box."""

    corner: tuple[int, int]
    by: int
    length: float
    normals: Floats
    mask: NDArray[np.bool_]
    depth: Floats
    edge: Floats
    ink: NDArray[np.bool_]
    votes: Floats | None

    def of_canvas(self, hint: DepthHint) -> DepthHint:
        """A hint, in pixels of this."""
        (top, left), by = self.corner, self.by
        moved = (DepthPoint((p.x - left) / by, (p.y - top) / by) for p in hint.points)
        return replace(hint, points=tuple(moved))

    def on_canvas(self, points: Floats) -> Floats:
        """Points x, y of this, on the canvas."""
        found: Floats = points * np.float32(self.by) + np.array(self.corner[::-1], np.float32)
        return found


def _small_of(prediction: Prediction, mask: NDArray[np.bool_], lines: Floats) -> _Small:
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    top, left = int(rows[0]), int(columns[0])
    sides = int(rows[-1]) + 1 - top, int(columns[-1]) + 1 - left
    by = max(1, round(max(sides) / SMALL_PX))
    counts = -(-sides[0] // by), -(-sides[1] // by)

    def blocks(plane: NDArray[Any]) -> Iterator[NDArray[Any]]:
        """Each pixel of all blocks in turn: many times faster than to reduce two axes."""
        cut = plane[top : top + counts[0] * by, left : left + counts[1] * by]
        more = [(0, counts[axis] * by - cut.shape[axis]) for axis in (0, 1)]
        whole = np.pad(cut, more + [(0, 0)] * (cut.ndim - 2))
        return (whole[row::by, column::by] for row in range(by) for column in range(by))

    def mean(plane: NDArray[Any]) -> Floats:
        total = reduce(np.add, (part.astype(np.float32) for part in blocks(plane)))
        return np.asarray(total / np.float32(by * by))

    share = mean(mask)
    inside = share >= min(0.5, float(share.max()))
    covered = np.asarray(np.maximum(share, 1e-6), np.float32)
    unknown = np.zeros(mask.shape, np.float32)
    depth = unknown if prediction.depth is None else prediction.depth
    edge = unknown if prediction.edge is None else prediction.edge
    votes = prediction.votes
    return _Small(
        corner=(top, left),
        by=by,
        length=max(sides) / by,
        normals=usable_normals(mean(prediction.normals), inside),
        mask=inside,
        depth=mean(depth) / covered / np.float32(by),
        edge=mean(edge) / covered,
        ink=(reduce(np.maximum, blocks(lines)) > INK) & inside,
        votes=None if votes is None else mean(votes),
    )


def _occlusions(small: _Small) -> tuple[list[Occlusion], list[Stroke]]:
    """The occlusions, and the strokes that they are parts of."""
    strokes = find_strokes(small.ink, small.length)
    if not strokes:
        return [], []
    order = small.depth
    if small.votes is None:
        height = inflate_direct(small.normals, small.mask, tolerance=ROUGH)
        order = np.float32(ORDER_BY_DEPTH) * order + height
    return (
        find_occlusions(
            strokes, small.ink, order, small.edge, small.mask, small.length, small.votes
        ),
        strokes,
    )


def _steps(small: _Small, hints: Sequence[DepthHint]) -> list[tuple[Occlusion, Floats]]:
    """The occlusions and the steps along them, in pixels of ``small``."""
    found, strokes = _occlusions(small)
    inside = [small.of_canvas(hint) for hint in hints]
    found = apply_hints(found, strokes, inside, small.mask, small.length)
    if not found:
        return []
    cuts = Cuts.none(small.mask.shape)
    for occlusion in found:
        if occlusion.front == "joined":
            continue
        ones = np.ones(len(occlusion.points), np.float32)
        cuts.add(occlusion.points, occlusion.towards, ones, small.mask)
    prior = Prior(small.depth, (PRIOR / small.length) ** 2)
    held = inflate_direct(small.normals, small.mask, cuts, hold=0, prior=prior, tolerance=ROUGH)
    reach = max(1, round(POOL * small.length))
    measured = []
    for occlusion in found:
        if occlusion.front == "joined":
            measured.append((occlusion, np.zeros(len(occlusion.points), np.float32)))
            continue
        jumps = jumps_across(occlusion.points, occlusion.towards, held, small.mask, cuts)
        steps = GAIN * mean_along(jumps, np.isfinite(jumps), reach)
        steps = np.clip(steps, LEAST * small.length, LARGEST * small.length)
        if occlusion.amount > 0:
            steps = np.full_like(steps, occlusion.amount * small.length)
        measured.append((occlusion, steps * _taper(occlusion, TAPER * small.length)))
    return measured


def _taper(occlusion: Occlusion, far: float) -> Floats:
    """(N,) 0 to 1: how much of the step there is, from an open end on."""
    count = len(occlusion.points)
    ramp = np.minimum(np.arange(count) / max(1.0, min(far, count / 2)), 1)
    ramp = ramp * ramp * (3 - 2 * ramp)
    share = np.ones(count)
    for end, ramped in zip(occlusion.open_ends, (ramp, ramp[::-1]), strict=True):
        if end:
            share = share * ramped
    return share.astype(np.float32)
