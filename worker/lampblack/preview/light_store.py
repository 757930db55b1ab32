"""Traced light, kept by contribution."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .bounded import MIB, BoundedStore
from .contribution import LightContribution
from .refinement import LOW, MISSING, PASSING

Floats = NDArray[np.float32]


@dataclass(frozen=True)
class AccumulatedLight:
    """The light of one contribution: ``first`` and ``second`` are diffuse and glossy light of the
    character, or cast and open light of the floor; ``level`` says how fine."""

    level: int
    spp: int
    amounts: tuple[float, ...]
    first: Floats
    second: Floats

    @property
    def nbytes(self) -> int:
        """Memory it takes."""
        return self.first.nbytes + self.second.nbytes


class LightStore:
    """Light by contribution. What was traced in passing has little room of its own, so that a
    long drag does not push out what was traced at rest."""

    def __init__(self) -> None:
        self._moving: BoundedStore[object, AccumulatedLight] = BoundedStore(16 * MIB)
        self._resting: BoundedStore[object, AccumulatedLight] = BoundedStore(192 * MIB)

    def put(self, contribution: LightContribution, light: AccumulatedLight) -> None:
        """Keep the light of ``contribution``."""
        store = self._moving if light.level < LOW else self._resting
        store.put(contribution.key, light, light.nbytes)

    def get(self, contribution: LightContribution) -> AccumulatedLight | None:
        """The finest light there is of ``contribution``, perhaps under other amounts of gloss."""
        return self._resting.get(contribution.key) or self._moving.get(contribution.key)

    def level(self, contribution: LightContribution) -> int:
        """How fine its light is under its own amounts of gloss; ``MISSING`` if there is none."""
        held = self.get(contribution)
        if held is None:
            return MISSING
        return held.level if held.amounts == contribution.amounts else PASSING

    def keep(self, contributions: Iterable[LightContribution]) -> None:
        """Drop all that was traced at rest for anything else."""
        self._resting.keep({contribution.key for contribution in contributions})

    @property
    def full(self) -> bool:
        """Whether more light would push out what is kept."""
        return self._resting.nbytes > 0.8 * self._resting.max_bytes
