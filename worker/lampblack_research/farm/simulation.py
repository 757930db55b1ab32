"""A render farm as a discrete-event simulation: how large should its tasks be?

Large tasks waste less on starting; small ones leave no machine alone with the last of the work.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Farm:
    """Machines and what a task costs on them. Times are wall seconds on a machine of speed 1.

    Attributes:
        machines: number of machines.
        start: to start a task: interpreter, network, renderer, and the neighbours of its first
            drawing.
        drawing: for each drawing with the frames that repeat it.
        variation: standard deviation of the logarithm of a drawing's time.
        speeds: standard deviation of the logarithm of a machine's speed.
        losses: how often an hour a machine is lost or taken away. Its task starts again on
            another; drawings that were finished are kept.
        dispatch: seconds that the scheduler takes for each task, one after the other.
    """

    machines: int
    start: float
    drawing: float
    variation: float = 0.3
    speeds: float = 0.15
    losses: float = 0.02
    dispatch: float = 0.005


@dataclass(frozen=True)
class Run:
    """One simulated shot.

    Attributes:
        seconds: until its last drawing is done.
        utilisation: share of all machines' time in which drawings were lit.
        straggling: share of ``seconds`` in which less than nine tenths of the machines worked.
        tasks: number of tasks, restarts included.
    """

    seconds: float
    utilisation: float
    straggling: float
    tasks: int


def simulate(farm: Farm, sizes: Sequence[int], seed: int = 0) -> Run:
    """Light tasks of ``sizes`` drawings, given out in this order to whichever machine is free."""
    rng = np.random.default_rng(seed)
    speed = np.exp(rng.normal(0, farm.speeds, farm.machines))
    waiting = list(sizes)[::-1]
    free = [(0.0, machine) for machine in range(farm.machines)]
    scheduler = lit = 0.0
    given = 0
    ended = np.zeros(farm.machines)
    running: list[tuple[float, int]] = []
    while waiting or running:
        # A task that is lost comes back when its machine is, which may be before the next is free.
        while running and (not waiting or running[0][0] <= free[0][0]):
            _, left = heapq.heappop(running)
            waiting.append(left)
        now, machine = heapq.heappop(free)
        size = waiting.pop()
        scheduler = max(now, scheduler) + farm.dispatch
        spent = farm.drawing * np.exp(rng.normal(-(farm.variation**2) / 2, farm.variation, size))
        done = scheduler + (farm.start + np.cumsum(spent)) / speed[machine]
        given += 1
        lost = scheduler + rng.exponential(3600 / farm.losses) if farm.losses else np.inf
        finished = int(np.searchsorted(done, lost, "right"))
        lit += float(spent[:finished].sum()) / speed[machine]
        until = float(done[-1])
        if finished < size:
            until = lost
            heapq.heappush(running, (lost, size - finished))
        ended[machine] = until if finished == size else done[finished - 1] if finished else now
        heapq.heappush(free, (until, machine))
    end = float(ended.max())
    return Run(end, lit / (end * farm.machines), _straggling(ended, end), given)


def _straggling(ended: NDArray[np.float64], end: float) -> float:
    return 1 - float(np.quantile(ended, 0.1)) / end


def equal_tasks(drawings: int, size: int) -> list[int]:
    """Tasks of ``size`` drawings; the last one may be smaller."""
    whole, rest = divmod(drawings, size)
    return [size] * whole + [rest] * (rest > 0)


def shrinking_tasks(drawings: int, machines: int, smallest: int) -> list[int]:
    """Guided self-scheduling (Polychronopoulos 1987): each task is a share of what is left, half of
    what each machine would get."""
    sizes = []
    while drawings:
        size = min(drawings, max(smallest, drawings // (2 * machines)))
        sizes.append(size)
        drawings -= size
    return sizes
