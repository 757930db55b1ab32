"""What the threads of the worker share: what is wanted, and what has been made so far."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..protocol import ErrorCode, Pixels, Role, error_message
from ..protocol.fields import Message
from .bounded import BoundedStore
from .model import Grade, Model, Planes
from .snapshot import Snapshot
from .source import LOW, Source

Floats = NDArray[np.float32]

MIB = 1 << 20
Deliver = Callable[[str, Message, Mapping[Role, Pixels] | None], None]
"""Hands a message for a session to the owner of the sockets; any thread may call it."""


@dataclass(frozen=True)
class Developed:
    """The light of one source: ``first`` and ``second`` are diffuse and glossy light of the
    figure, or cast and open light of the floor; ``rung`` says how fine."""

    rung: int
    spp: int
    amounts: tuple[float, ...]
    first: Floats
    second: Floats

    @property
    def nbytes(self) -> int:
        """Memory it takes."""
        return self.first.nbytes + self.second.nbytes


class LightStore:
    """Light by source. What was traced in passing has little room of its own, so that a long
    drag does not wash out what was traced at rest."""

    def __init__(self) -> None:
        self._moving: BoundedStore[object, Developed] = BoundedStore(16 * MIB)
        self._resting: BoundedStore[object, Developed] = BoundedStore(192 * MIB)

    def put(self, source: Source, light: Developed) -> None:
        """Keep the light of ``source``."""
        store = self._moving if light.rung < LOW else self._resting
        store.put(source.key, light, light.nbytes)

    def get(self, source: Source) -> Developed | None:
        """The finest light of ``source`` at hand, perhaps under other amounts of gloss."""
        return self._resting.get(source.key) or self._moving.get(source.key)

    def rung(self, source: Source) -> int:
        """How fine its light is under its own amounts of gloss; -1 for none that can be shown."""
        held = self.get(source)
        if held is None:
            return -1
        return held.rung if held.amounts == source.amounts else 0

    def keep(self, sources: Iterable[Source]) -> None:
        """Let go of all that was traced for anything else."""
        self._resting.keep({source.key for source in sources})

    @property
    def full(self) -> bool:
        """Whether more light would push out what is kept."""
        return self._resting.nbytes > 0.8 * self._resting.max_bytes


@dataclass
class Studio:
    """State behind one lock, whose condition is notified when any of it changes.

    Attributes:
        wanted: by session, what is to be shown; looks without a drawing are not there.
        ahead: what may be looked at next, nearest first.
        models_wanted: drawings to make models of, the most urgent first.
        changed: when something that is shown last changed, monotonic seconds.
        failed: drawings that cannot be lit.
    """

    deliver: Deliver
    wanted: dict[str, Snapshot] = field(default_factory=dict)
    ahead: tuple[Snapshot, ...] = ()
    models_wanted: tuple[tuple[str, Grade], ...] = ()
    changed: float = 0.0
    closing: bool = False
    failed: dict[str, Message] = field(default_factory=dict)
    preview_state: Any = "starting"
    job_state: Any = "off"
    condition: threading.Condition = field(default_factory=threading.Condition)
    planes: BoundedStore[str, Planes] = field(default_factory=lambda: BoundedStore(192 * MIB))
    models: BoundedStore[tuple[str, Grade], Model] = field(
        default_factory=lambda: BoundedStore(320 * MIB)
    )
    lights: LightStore = field(default_factory=LightStore)

    def model(self, digest: str) -> Model | None:
        """The best model of a drawing at hand."""
        return self.models.get((digest, "fine")) or self.models.get((digest, "coarse"))

    def update(self, **state: Any) -> None:
        """Set attributes and wake whoever waits for a change."""
        with self.condition:
            for name, value in state.items():
                setattr(self, name, value)
            self.condition.notify_all()

    def still_for(self) -> float:
        """Seconds since something that is shown changed."""
        return time.monotonic() - self.changed

    def tell_all(self, code: ErrorCode, **words: Any) -> None:
        """Tell every client that looks at something of an error, once."""
        for session in list(self.wanted):
            self.deliver(session, error_message(code, **words), None)
