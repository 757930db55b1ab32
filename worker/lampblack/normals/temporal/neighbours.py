"""Which drawings of a shot precede and follow each."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

NeighbourKeys = tuple[tuple[str, ...], tuple[str, ...]]
"""Before and after, nearest first."""


def neighbour_keys(shown: Sequence[str], reach: int) -> dict[str, NeighbourKeys]:
    """What is around each drawing, from the names of what the frames show, in order.

    A drawing that is held counts once. One that comes back has one past and one future, since
    it is lit once: those of the first time that it has them whole (so a cycle has no seam).
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
