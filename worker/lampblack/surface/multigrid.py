"""Aggregation multigrid for the Laplacian of a weighted graph of pixels.

The graph of a character has ragged borders, holes and, along creases and rims, lines of very
weak links. Geometric coarsening converges slowly on it. So pixels are paired along their
strongest links, twice per level, and a coarse link is the sum of the links between its two
aggregates (Galerkin with piecewise constants). A K-cycle, two steps of conjugate gradient on
every coarse level, compensates for the simple interpolation: Notay, "An aggregation-based
algebraic multigrid method", ETNA 37, 2010.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled

Floats = NDArray[np.float32]
Ints = NDArray[np.int32]

STRONG = 0.25
"""Nodes pair along a link of at least this share of their strongest."""
COARSEST = 160
"""At most this many nodes are solved directly."""


@dataclass(frozen=True)
class Graph:
    """A symmetric weighted graph in compressed rows; its Laplacian is ``diag - weights``.

    Attributes:
        starts: (N + 1,) where each node's links start.
        ends: (L,) the node at the other end.
        weights: (L,) non-negative.
        inverse: (N,) one over the sum of each node's weights; 0 where it has no links.
    """

    starts: Ints
    ends: Ints
    weights: Floats
    inverse: Floats

    def __len__(self) -> int:
        return len(self.inverse)


class Multigrid:
    """One K-cycle, an approximate inverse of the graph's Laplacian, to precondition with."""

    def __init__(self, graph: Graph) -> None:
        self._graphs = [graph]
        self._aggregates: list[Ints] = []
        while len(self._graphs[-1]) > COARSEST:
            aggregate, coarse = _coarsen(self._graphs[-1])
            self._aggregates.append(aggregate)
            self._graphs.append(coarse)
        self._inverse = _pseudo_inverse(self._graphs[-1])

    def __call__(self, residual: Floats) -> Floats:
        """An approximate solution of ``Laplacian x = residual``; both (N,) float32."""
        return self._cycle(0, residual)

    def _cycle(self, level: int, residual: Floats) -> Floats:
        if level == len(self._aggregates):
            coarsest: Floats = (self._inverse * residual).sum(axis=1)
            return coarsest
        graph, aggregate = self._graphs[level], self._aggregates[level]
        x = np.empty_like(residual)
        coarse = np.zeros(len(self._graphs[level + 1]), np.float32)
        links = graph.starts, graph.ends, graph.weights, graph.inverse
        _smooth_down(*links, residual, x)
        _restrict(*links[:3], residual, x, aggregate, coarse)
        _smooth_up(*links, residual, x, aggregate, self._krylov(level + 1, coarse))
        return x

    def _krylov(self, level: int, residual: Floats) -> Floats:
        """Up to two flexible conjugate gradient steps on a coarse level.

        The first coarse level takes one: visiting it twice costs more than it saves.
        """
        first = self._cycle(level, residual)
        if level == len(self._aggregates):
            return first
        image, energy, work, before = self._apply(level, first, residual)
        if energy <= 0:
            return first
        if level == 1:
            return np.float32(work / energy) * first
        residual = residual - np.float32(work / energy) * image
        if dot(residual, residual) <= 0.0625 * before:
            return np.float32(work / energy) * first
        second = self._cycle(level, residual)
        cross = dot(second, image)
        _, second_energy, second_work, _ = self._apply(level, second, residual)
        second_energy -= cross**2 / energy
        if second_energy <= 0:
            return np.float32(work / energy) * first
        step = second_work / second_energy
        return np.float32((work - cross * step) / energy) * first + np.float32(step) * second

    def _apply(self, level: int, x: Floats, residual: Floats) -> tuple[Floats, float, float, float]:
        """The Laplacian of x, x' A x, x' r and r' r."""
        graph = self._graphs[level]
        image = np.empty_like(x)
        apply_laplacian(graph.starts, graph.ends, graph.weights, x, image)
        return image, dot(x, image), dot(x, residual), dot(residual, residual)


def dot(a: NDArray[np.floating[Any]], b: NDArray[np.floating[Any]]) -> float:
    """The sum of products. Unlike ``a @ b``, which shares long sums out to threads, it is the same
    on any number of cores."""
    return float(np.add.reduce(a * b))


def _coarsen(graph: Graph) -> tuple[Ints, Graph]:
    """Two passes of pairing: the aggregate of every node (-1: it has no links), and their graph."""
    first, count = _pair(graph.starts, graph.ends, graph.weights)
    half = Graph(*_sum_links(graph.starts, graph.ends, graph.weights, first, count))
    second, count = _pair(half.starts, half.ends, half.weights)
    coarse = Graph(*_sum_links(half.starts, half.ends, half.weights, second, count))
    return np.where(first < 0, np.int32(-1), second[first]), coarse


def _pseudo_inverse(graph: Graph) -> Floats:
    """Dense inverse on everything but the constants of the connected parts."""
    count = len(graph)
    dense = np.zeros((count, count))
    dense[np.repeat(np.arange(count), np.diff(graph.starts)), graph.ends] = -graph.weights
    np.fill_diagonal(dense, -dense.sum(axis=1))
    return np.linalg.pinv(dense, rcond=1e-9, hermitian=True).astype(np.float32)


@compiled
def _pair(starts: Ints, ends: Ints, weights: Floats) -> tuple[Ints, int]:
    count = len(starts) - 1
    aggregate = np.full(count, -1, np.int32)
    found = 0
    for i in range(count):
        if aggregate[i] >= 0 or starts[i] == starts[i + 1]:
            continue
        nearest, strongest = -1, np.float32(-1)
        partner, best = -1, np.float32(-1)
        for k in range(starts[i], starts[i + 1]):
            w = weights[k]
            if w > strongest:
                strongest, nearest = w, ends[k]
            if aggregate[ends[k]] < 0 and w > best:
                best, partner = w, ends[k]
        if partner < 0 or best < STRONG * strongest:
            aggregate[i] = aggregate[nearest]
        else:
            aggregate[i] = aggregate[partner] = found
            found += 1
    return aggregate, found


@compiled
def _sum_links(
    starts: Ints, ends: Ints, weights: Floats, aggregate: Ints, count: int
) -> tuple[Ints, Ints, Floats, Floats]:
    first = np.zeros(count + 1, np.int32)
    for a in aggregate:
        if a >= 0:
            first[a + 1] += 1
    for a in range(count):
        first[a + 1] += first[a]
    members = np.empty(first[count], np.int32)
    filled = first[:-1].copy()
    for i in range(len(aggregate)):
        a = aggregate[i]
        if a >= 0:
            members[filled[a]] = i
            filled[a] += 1
    coarse_starts = np.zeros(count + 1, np.int32)
    coarse_ends = np.empty(len(ends), np.int32)
    coarse_weights = np.empty(len(ends), np.float32)
    inverse = np.zeros(count, np.float32)
    slot = np.full(count, -1, np.int32)
    used = 0
    for a in range(count):
        start = used
        for m in range(first[a], first[a + 1]):
            i = members[m]
            for k in range(starts[i], starts[i + 1]):
                b = aggregate[ends[k]]
                if b == a:
                    continue
                if slot[b] < start:
                    slot[b] = used
                    coarse_ends[used] = b
                    coarse_weights[used] = weights[k]
                    used += 1
                else:
                    coarse_weights[slot[b]] += weights[k]
        total = np.float32(0)
        for k in range(start, used):
            total += coarse_weights[k]
        if total > 0:
            inverse[a] = np.float32(1) / total
        coarse_starts[a + 1] = used
    return coarse_starts, coarse_ends[:used].copy(), coarse_weights[:used].copy(), inverse


@compiled
def apply_laplacian(
    starts: Ints,
    ends: Ints,
    weights: Floats,
    x: NDArray[np.floating[Any]],
    image: NDArray[np.floating[Any]],
) -> None:
    """The Laplacian of x, by differences: exactly 0 for a constant."""
    for i in range(len(x)):
        here = x[i]
        total = here - here
        for k in range(starts[i], starts[i + 1]):
            total += weights[k] * (here - x[ends[k]])
        image[i] = total


@compiled
def _smooth_down(
    starts: Ints, ends: Ints, weights: Floats, inverse: Floats, residual: Floats, x: Floats
) -> None:
    """Gauss-Seidel from zero, first node to last."""
    x[:] = 0
    for i in range(len(x)):
        total = residual[i]
        for k in range(starts[i], starts[i + 1]):
            total += weights[k] * x[ends[k]]
        x[i] = total * inverse[i]


@compiled
def _restrict(
    starts: Ints,
    ends: Ints,
    weights: Floats,
    residual: Floats,
    x: Floats,
    aggregate: Ints,
    coarse: Floats,
) -> None:
    for i in range(len(x)):
        a = aggregate[i]
        if a >= 0:
            total = residual[i]
            for k in range(starts[i], starts[i + 1]):
                total -= weights[k] * (x[i] - x[ends[k]])
            coarse[a] += total


@compiled
def _smooth_up(
    starts: Ints,
    ends: Ints,
    weights: Floats,
    inverse: Floats,
    residual: Floats,
    x: Floats,
    aggregate: Ints,
    coarse: Floats,
) -> None:
    """Add the coarse correction, then Gauss-Seidel, last node to first."""
    for i in range(len(x)):
        if aggregate[i] >= 0:
            x[i] += coarse[aggregate[i]]
    for i in range(len(x) - 1, -1, -1):
        total = residual[i]
        for k in range(starts[i], starts[i + 1]):
            total += weights[k] * x[ends[k]]
        x[i] = total * inverse[i]
