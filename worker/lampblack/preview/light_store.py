"""The store of traced light, by contribution."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .bounded import MIB, BoundedStore
from .contribution import LightContribution
from .refinement import LOW, MISSING, PASSING

MAX_KIN, MAX_PLACES = 64, 16
"""Most lights on a drawing, and places of each, that are remembered as neighbours."""

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class AccumulatedLight:
    """The light of one contribution at a refinement ``level``: ``first`` and ``second`` are diffuse
    and glossy light of the character, or the floor's light with and without the character."""

    level: int
    spp: int
    amounts: tuple[float, ...]
    first: Floats
    second: Floats

    @property
    def nbytes(self) -> int:
        """Memory in bytes."""
        return self.first.nbytes + self.second.nbytes


class LightStore:
    """Light by contribution. Light that was traced during a drag has its own small memory, so that
    a long drag does not displace light that was traced at rest."""

    def __init__(self) -> None:
        self._moving: BoundedStore[object, AccumulatedLight] = BoundedStore(16 * MIB)
        self._resting: BoundedStore[object, AccumulatedLight] = BoundedStore(192 * MIB)
        self._kin: BoundedStore[object, tuple[LightContribution, ...]] = BoundedStore(MAX_KIN)

    def put(self, contribution: LightContribution, light: AccumulatedLight) -> None:
        """Store the light of ``contribution``."""
        store = self._moving if light.level < LOW else self._resting
        store.put(contribution.key, light, light.nbytes)
        others = (c for c in self._kin.get(contribution.kin) or () if c.key != contribution.key)
        self._kin.put(contribution.kin, (*others, contribution)[-MAX_PLACES:], 1)

    def get(self, contribution: LightContribution) -> AccumulatedLight | None:
        """The finest light of ``contribution``, possibly with other amounts of gloss."""
        return self._resting.get(contribution.key) or self._moving.get(contribution.key)

    def nearest(
        self, contribution: LightContribution
    ) -> tuple[LightContribution, AccumulatedLight] | None:
        """The same light, as it was traced at the nearest of its last places."""
        kin = self._kin.get(contribution.kin) or ()
        for other in sorted(kin, key=contribution.distance_to):
            light = self.get(other)
            if light is not None:
                return other, light
        return None

    def level(self, contribution: LightContribution) -> int:
        """The level of its light with its own amounts of gloss; ``MISSING`` if there is none."""
        held = self.get(contribution)
        if held is None:
            return MISSING
        return held.level if held.amounts == contribution.amounts else PASSING

    def keep(self, contributions: Iterable[LightContribution]) -> None:
        """Drop all light that was traced at rest for other contributions."""
        self._resting.keep({contribution.key for contribution in contributions})

    @property
    def full(self) -> bool:
        """Whether more light would displace stored light."""
        return self._resting.nbytes > 0.8 * self._resting.max_bytes
