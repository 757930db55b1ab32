"""Streams training examples from a data set into memory. The data set may still grow."""

from __future__ import annotations

import multiprocessing
import os
import queue
import time
from collections import defaultdict
from collections.abc import Callable
from multiprocessing.queues import Queue
from pathlib import Path
from types import TracebackType
from typing import Generic, Self, TypeVar

import numpy as np
import torch

from lampblack.errors import LampblackError

from ..dataset.triple import Triple, entry_paths

RESCAN_SECONDS = 60
FEWEST = 64
RENEWED = 8
"""Largest number of new examples added before each batch. New ones teach more than repeated
ones."""

_PATIENCE_SECONDS = 30

Example = TypeVar("Example")
Prepare = Callable[[Triple, np.random.Generator], Example]


class Stream(Generic[Example]):
    """Keeps ``capacity`` examples; a loader process replaces them. Use as a context manager.

    A source is chosen with a probability that grows with the square root of its number of entries,
    so that a large source does not dominate the small ones.

    Args:
        data: a folder of triples, see ``dataset.build``.
        prepare: makes an example from a triple. It runs in the loader, so it must be importable.
        kind: examples of one kind may share a batch.
    """

    def __init__(
        self,
        data: Path,
        prepare: Prepare[Example],
        kind: Callable[[Example], object],
        *,
        seed: int,
        capacity: int = 2000,
    ) -> None:
        if not entries_by_source(data):
            raise LampblackError(
                f"{data} holds no data set.", "Make one with lampblack dataset build."
            )
        context = multiprocessing.get_context("spawn")
        self._fresh: Queue[Example] = context.Queue(maxsize=2 * RENEWED)
        self._loader = context.Process(
            target=_load, args=(self._fresh, data, prepare, seed), daemon=True
        )
        self._kind = kind
        self._capacity = capacity
        self._kept: dict[object, list[Example]] = defaultdict(list)
        self._count = 0
        self._fewest = min(FEWEST, capacity)

    def __enter__(self) -> Self:
        self._loader.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._loader.kill()
        self._loader.join()

    def take(self, size: int, rng: np.random.Generator) -> list[Example]:
        """Add new examples; then return ``size`` random examples of one kind."""
        self._renew(RENEWED, rng)
        kinds = list(self._kept)
        counts = np.array([len(self._kept[kind]) for kind in kinds])
        kept = self._kept[kinds[rng.choice(len(kinds), p=counts / counts.sum())]]
        return [kept[rng.integers(len(kept))] for _ in range(size)]

    def _renew(self, most: int, rng: np.random.Generator) -> None:
        """Wait for new examples only while there are too few."""
        while most > 0 or self._count < self._fewest:
            scarce = self._count < self._fewest
            try:
                example = self._fresh.get(timeout=_PATIENCE_SECONDS if scarce else 0.001)
            except queue.Empty:
                if scarce and not self._loader.is_alive():
                    raise LampblackError("The data set's entries cannot be read.") from None
                if not scarce:
                    return
                continue
            most -= 1
            kept = self._kept[self._kind(example)]
            if kept and self._count >= self._capacity:
                kept[rng.integers(len(kept))] = example
            else:
                kept.append(example)
                self._count += 1


def entries_by_source(data: Path) -> dict[str, list[Path]]:
    """The entries of a data set, by the source of their models."""
    sources: dict[str, list[Path]] = defaultdict(list)
    for path in entry_paths(data):
        sources[path.parent.name].append(path)
    return dict(sources)


def _load(fresh: Queue[Example], data: Path, prepare: Prepare[Example], seed: int) -> None:
    """The loader process. It ends when its parent ends."""
    torch.set_num_threads(1)
    fresh.cancel_join_thread()  # otherwise it waits at exit for a dead parent to read the queue
    parent = os.getppid()
    rng = np.random.default_rng([seed, 1])
    scanned = -float("inf")
    while os.getppid() == parent:
        if time.monotonic() - scanned > RESCAN_SECONDS:
            sources = entries_by_source(data)
            names = sorted(sources)
            shares = np.sqrt([len(sources[name]) for name in names])
            scanned = time.monotonic()
        name = names[rng.choice(len(names), p=shares / shares.sum())]
        path = sources[name][rng.integers(len(sources[name]))]
        try:
            example = prepare(Triple.load(path), rng)
        except LampblackError:
            continue
        while os.getppid() == parent:
            try:
                fresh.put(example, timeout=2)
                break
            except queue.Full:
                continue
