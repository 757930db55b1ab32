"""Two installed versions of Lampblack measured side by side, in turns, on a machine that is busy.

A busy machine slows both alike. So each round runs both, one right after the other, and only the
ratios of a round count.
"""

from __future__ import annotations

import subprocess
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
from scipy import stats

from ..errors import LampblackError

ROUNDS = 5
CONFIDENCE = 0.95

Figures = Mapping[str, float]
Measure = Callable[[], Figures]


@dataclass(frozen=True)
class Ratio:
    """One figure of both versions.

    Attributes:
        here, there: medians over the rounds.
        ratio: geometric mean of ``here / there`` over the rounds: below 1 this version is lower.
        low, high: its 95 % interval (Student's t of the logarithms).
    """

    here: float
    there: float
    ratio: float
    low: float
    high: float


def alternate(here: Measure, there: Measure, rounds: int) -> Iterator[tuple[Figures, Figures]]:
    """Run both ``rounds`` times. The first of a round takes turns, since it warms the caches of the
    machine for the second."""
    for number in range(rounds):
        if number % 2:
            second = there()
            yield here(), second
        else:
            first = here()
            yield first, there()


def ratios(pairs: Sequence[tuple[Figures, Figures]]) -> dict[str, Ratio]:
    """The ratios of all figures that both versions give in every round and that are positive.

    Args:
        pairs: the figures of this version and of the other, at least two rounds.
    """
    common = set.intersection(*(set(a) & set(b) for a, b in pairs))
    found = {}
    for name in (name for name in pairs[0][0] if name in common):
        values = np.array([[a[name], b[name]] for a, b in pairs], float)
        if not (values > 0).all():
            continue
        logs = np.log(values[:, 0] / values[:, 1])
        middle = float(logs.mean())
        spread = float(stats.sem(logs) * stats.t.ppf((1 + CONFIDENCE) / 2, len(logs) - 1))
        here, there = np.median(values, axis=0)
        bounds = np.exp([middle, middle - spread, middle + spread])
        found[name] = Ratio(float(here), float(there), *map(float, bounds))
    return found


def installed(executable: Path, arguments: Sequence[str]) -> Measure:
    """Measures by running ``lampblack bench`` of an installed version.

    Args:
        executable: its ``lampblack``, or the folder of its virtual environment.
        arguments: of ``bench``, without ``--json``.

    Raises:
        LampblackError: it is no such program; when measured, it failed.
    """
    places = (executable, executable / "bin" / "lampblack", executable / "Scripts/lampblack.exe")
    program = next((place for place in places if place.is_file()), None)
    if program is None:
        raise LampblackError(
            f"There is no lampblack in {executable}.",
            "Name the virtual environment in which the other version is installed.",
        )
    command = [str(program.absolute()), "bench", *arguments, "--json"]

    def measure() -> dict[str, float]:
        try:
            run = subprocess.run(command, capture_output=True, check=True)
            return msgspec.json.decode(run.stdout, type=dict[str, float])
        except (OSError, msgspec.DecodeError) as error:
            details = str(error)
        except subprocess.CalledProcessError as error:
            details = error.stderr.decode(errors="replace").strip()[-2000:]
        raise LampblackError(
            f"{program} could not be measured.", f"Try it alone: {' '.join(command)}", details
        )

    return measure
