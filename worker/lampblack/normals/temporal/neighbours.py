"""The neighbours of each drawing in a shot: those before and after it."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

REACH = 2
"""Number of neighbours on either side."""

NeighbourKeys = tuple[tuple[str, ...], tuple[str, ...]]
"""Names of the drawings before and after, each nearest first."""


def neighbour_keys(shown: Sequence[str], reach: int) -> dict[str, NeighbourKeys]:
    """The neighbours of each drawing, from the drawings that the frames show, in order.

    A drawing that is held over several frames counts once. A drawing that appears again has one
    set of neighbours, since it is lit once: those of the first appearance with a full set, so
    that a cycle has no seam.
    """
    runs = [name for name, _ in groupby(shown)]
    around: dict[str, NeighbourKeys] = {}
    for index, name in enumerate(runs):
        before = tuple(runs[max(0, index - reach) : index][::-1])
        after = tuple(runs[index + 1 : index + 1 + reach])
        known = around.get(name, ((), ()))
        around[name] = (
            before if len(before) > len(known[0]) else known[0],
            after if len(after) > len(known[1]) else known[1],
        )
    return around
