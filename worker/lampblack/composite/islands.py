"""Islands: regions of a tone that are too small to be meant."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled

MOST_ISLANDS = 60
MARGIN = 0.25
"""Islands are sought a little beyond a threshold too, by this share of it."""
SHORE, AROUND = 1, 3
"""How far beside an island its shore reaches, and the light that it takes, in elements."""

Floats = NDArray[np.float32]
Runs = NDArray[np.int32]
"""(n, 3) row, first column and the column after the last."""


def without_islands(amount: Floats, lows: Floats, highs: Floats, smallest: int) -> Floats:
    """``amount``, (h, w), without the regions of fewer than ``smallest`` elements that a step
    cuts out.

    Args:
        lows, highs: (n,) where each step begins and ends.
    """
    found = amount
    for low, high in zip(lows, highs, strict=True):
        # Also what crosses half of a soft step, or nearly crosses it: it would be seen as a ghost.
        bright, dark = (high, low, low * (1 - MARGIN)), (low, high, high * (1 + MARGIN))
        # Both ends of a hard step are one level.
        for level, lit in (
            *((level, True) for level in dict.fromkeys(bright)),
            *((level, False) for level in dict.fromkeys(dark)),
        ):
            islands = small_regions(found, np.float32(level), smallest, above=lit)
            if islands and found is amount:
                found = found.copy()
            for island in islands:
                _flood(found, island)
    return found


def small_regions(plane: Floats, level: np.float32, smallest: int, *, above: bool) -> list[Runs]:
    """The connected regions of fewer than ``smallest`` elements of ``plane`` that are above
    ``level``, or below it; ``MOST_ISLANDS`` of them at most, topmost first."""
    runs, regions = _small(np.require(plane, np.float32, ("C", "W")), level, above, smallest)
    if not len(runs):
        return []
    numbers, first = np.unique(regions, return_index=True)
    topmost = numbers[np.argsort(first)][:MOST_ISLANDS]
    return [runs[regions == number] for number in topmost]


@compiled
def _flood(amount: Any, island: Any) -> None:
    """Give ``island``, and the elements beside it, the light around them."""
    rows, columns = amount.shape
    top, left = max(0, island[:, 0].min() - AROUND), max(0, island[:, 1].min() - AROUND)
    bottom = min(rows, island[:, 0].max() + AROUND + 1)
    right = min(columns, island[:, 2].max() + AROUND)
    window = amount[top:bottom, left:right]
    place = np.zeros(window.shape, np.uint8)
    for value, reach in ((AROUND, AROUND), (SHORE, SHORE)):
        for run in range(len(island)):
            row, start, stop = island[run, 0] - top, island[run, 1] - left, island[run, 2] - left
            for near in range(max(row - reach, 0), min(row + reach + 1, bottom - top)):
                place[near, max(start - reach, 0) : min(stop + reach, right - left)] = value
    around = np.empty(place.size, np.float32)
    count = 0
    for row in range(place.shape[0]):
        for column in range(place.shape[1]):
            if place[row, column] == AROUND:
                around[count] = window[row, column]
                count += 1
    if count == 0:
        return
    light = np.median(around[:count])
    for row in range(place.shape[0]):
        for column in range(place.shape[1]):
            if place[row, column] == SHORE:
                window[row, column] = light


@compiled
def _small(plane: Any, level: Any, above: bool, smallest: int) -> Any:
    """Runs of elements in the small regions, and the region of each. Rows are joined run by run,
    which takes a fraction of the time of labelling elements."""
    height, width = plane.shape
    most = height * ((width + 1) // 2)
    runs, parents = np.empty((most, 3), np.int32), np.empty(most, np.int32)
    inside = np.zeros((width // 8 + 1) * 8, np.uint8)  # ends with an element that is outside
    eights, all_inside = inside.view(np.uint64), np.uint64(0x0101010101010101)
    sign = np.float32(1 if above else -1)
    count, over = 0, 0  # ``over`` is the first run of the row above
    for row in range(height):
        begin, start, values = count, -1, plane[row]
        for column in range(width):
            inside[column] = sign * values[column] > sign * level
        for eight in range(len(eights)):
            if eights[eight] == (all_inside if start >= 0 else np.uint64(0)):
                continue
            for column in range(8 * eight, 8 * eight + 8):
                if inside[column] and start < 0:
                    start = column
                elif not inside[column] and start >= 0:
                    runs[count, 0], runs[count, 1], runs[count, 2] = row, start, column
                    parents[count] = count
                    count, start = count + 1, -1
        upper = over
        for run in range(begin, count):
            while upper < begin and runs[upper, 2] <= runs[run, 1]:
                upper += 1
            at = upper
            while at < begin and runs[at, 1] < runs[run, 2]:
                one, other = _root(parents, run), _root(parents, at)
                parents[max(one, other)] = min(one, other)
                at += 1
        over = begin
    areas, chosen = np.zeros(count, np.int32), np.zeros(count, np.bool_)
    for run in range(count):
        parents[run] = _root(parents, run)
        areas[parents[run]] += runs[run, 2] - runs[run, 1]
    for run in range(count):
        chosen[run] = areas[parents[run]] < smallest
    return runs[:count][chosen], parents[:count][chosen]


@compiled
def _root(parents: Any, run: int) -> int:
    while parents[run] != run:
        parents[run] = parents[parents[run]]
        run = parents[run]
    return run
