"""The choice of the device that traces: a graphics card is taken once a tiny render on it came out
right, and what is known of the cards of this machine is remembered."""

from __future__ import annotations

import contextlib
import hashlib
import os
import platform
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from importlib import metadata
from pathlib import Path
from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta

from ..atomic import atomic_file
from ..cache import user_cache_folder
from ..choices import DeviceChoice, DeviceKind
from ..errors import OutputError
from ..files import read_bounded

PREFERENCE: tuple[DeviceKind, ...] = ("optix", "cuda", "hip", "oneapi", "metal")
"""The order in which cards are tried: OptiX is CUDA with the card's own ray tracing."""
DRIVERS = "drivers"
"""The entry of the search for cards itself, in which a broken driver may end the process."""
MAX_MEMORY_BYTES = 1 << 20
WAIT_SECONDS, LOOK_SECONDS = 8.0, 0.05
USED = "The processor is used."

Text = Annotated[str, Meta(max_length=2000)]


class Card(msgspec.Struct, frozen=True):
    """A graphics card, by one of Cycles' ways to it; ``identity`` tells equal cards apart."""

    kind: DeviceKind
    name: Text
    identity: Text

    @property
    def label(self) -> str:
        """Its name for people."""
        return f"{self.name} ({self.kind})"


class Verdict(msgspec.Struct, frozen=True):
    """What came of trying a card. ``trying`` is the verdict until another one is given, so that it
    remains if the card ends the process. ``denoises``: the card also denoises rightly."""

    outcome: Literal["trying", "right", "wrong"]
    denoises: bool = False
    why: Text = ""


@dataclass(frozen=True)
class Choice:
    """The device to use: ``card``, or the processor. ``notice`` is a sentence for the artist, or
    empty."""

    card: Card | None = None
    denoises: bool = False
    notice: str = ""


@dataclass
class Memory:
    """Verdicts in a file, by card; those of other drivers or another Blender are forgotten. A
    memory that cannot be read or written only costs time."""

    path: Path
    system: str = field(default_factory=lambda: system_digest())
    _verdicts: dict[str, Verdict] = field(default_factory=dict)

    def __post_init__(self) -> None:
        with contextlib.suppress(OSError, msgspec.DecodeError):
            stored = msgspec.json.decode(
                read_bounded(self.path, MAX_MEMORY_BYTES),
                type=tuple[str, dict[str, Verdict]],
            )
            if stored[0] == self.system:
                self._verdicts = stored[1]

    def verdict(self, key: str) -> Verdict | None:
        """What is known of ``key``."""
        return self._verdicts.get(key)

    def remember(self, key: str, verdict: Verdict) -> None:
        """Keep ``verdict``."""
        self._verdicts[key] = verdict
        with contextlib.suppress(OSError, OutputError):
            self.path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            with atomic_file(self.path) as file:
                file.write(msgspec.json.encode((self.system, self._verdicts)))


def memory_path() -> Path:
    """The file of the ``Memory`` of this user's machine."""
    return user_cache_folder() / "devices.json"


def system_digest() -> str:
    """A digest of what makes a card right or wrong: Blender's version, and the drivers'."""
    nvidia = Path("/proc/driver/nvidia/version")
    driver = ""
    with contextlib.suppress(OSError):
        driver = nvidia.read_text(errors="replace")[:4096]
    parts = metadata.version("bpy"), platform.release(), driver
    return hashlib.blake2b("\0".join(parts).encode(), digest_size=16).hexdigest()


def choose(
    wanted: DeviceChoice,
    find_cards: Callable[[], Sequence[Card]],
    try_card: Callable[[Card], Verdict],
    path: Path,
) -> Choice:
    """The device for ``wanted``. What is not remembered in ``path`` is tried, by one process at a
    time.

    Args:
        find_cards: the cards of this machine. It may raise RuntimeError, or end the process.
        try_card: renders on a card. It may raise RuntimeError, or end the process.
    """
    if wanted == "cpu":
        return Choice()
    with _alone(path) as alone:
        if not alone:
            return Choice(notice="The graphics card is being tried by another program. " + USED)
        return _choose(wanted, find_cards, try_card, Memory(path))


def _choose(
    wanted: DeviceChoice,
    find_cards: Callable[[], Sequence[Card]],
    try_card: Callable[[Card], Verdict],
    memory: Memory,
) -> Choice:
    searched = memory.verdict(DRIVERS)
    if searched is None:
        memory.remember(DRIVERS, Verdict("trying"))
    elif searched.outcome == "trying":
        memory.remember(DRIVERS, Verdict("wrong", why="The search for graphics cards crashed."))
        return Choice(notice=f"The search for graphics cards crashed. {USED}")
    elif searched.outcome == "wrong":
        return Choice(notice=f"{searched.why} {USED}" if wanted != "auto" else "")
    try:
        cards = [card for card in find_cards() if wanted in ("auto", card.kind)]
    except RuntimeError as error:
        why = f"The graphics cards could not be listed: {error}"[:500]
        memory.remember(DRIVERS, Verdict("wrong", why=why))
        return Choice(notice=f"{why}. {USED}")
    if searched is None:
        memory.remember(DRIVERS, Verdict("right"))
    if not cards and wanted != "auto":
        return Choice(notice=f"There is no graphics card for {wanted} here. {USED}")
    refused = ""
    for card in sorted(cards, key=lambda card: PREFERENCE.index(card.kind)):
        known = memory.verdict(_key(card))
        verdict = judge(card, try_card, memory)
        if verdict.outcome == "right":
            return Choice(card, verdict.denoises, refused)
        if verdict is not known or wanted != "auto":  # what was told once is not told again
            refused = refused or f"{card.label} is not used: {verdict.why}"
    return Choice(notice=f"{refused} {USED}" if refused else "")


def judge(card: Card, try_card: Callable[[Card], Verdict], memory: Memory) -> Verdict:
    """The verdict on ``card``: what is remembered, or else what comes of ``try_card``."""
    known = memory.verdict(_key(card))
    if known is not None and known.outcome != "trying":
        return known
    if known is not None:
        verdict = Verdict("wrong", why="a test picture on it ended the renderer.")
    else:
        memory.remember(_key(card), Verdict("trying"))
        try:
            verdict = try_card(card)
        except RuntimeError as error:
            verdict = Verdict("wrong", why=f"a test picture on it failed: {error}"[:500])
    memory.remember(_key(card), verdict)
    return verdict


def _key(card: Card) -> str:
    return f"{card.kind} {card.name} {card.identity}"


@contextlib.contextmanager
def _alone(path: Path) -> Iterator[bool]:
    """Whether no other process is in this context with the same ``path``; one that is, is waited
    for a while."""
    try:
        import fcntl

        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        lock = os.open(path.with_suffix(".lock"), os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    except (ImportError, OSError):
        yield True
        return
    try:
        yield any(_locked(fcntl, lock) for _ in range(round(WAIT_SECONDS / LOOK_SECONDS)))
    finally:
        os.close(lock)


def _locked(fcntl: Any, lock: int) -> bool:
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        time.sleep(LOOK_SECONDS)
        return False
    return True
