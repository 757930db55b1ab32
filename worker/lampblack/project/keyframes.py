"""Keyframes: each holds until the next one."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from typing import Protocol, TypeVar


class Keyframe(Protocol):
    """Any kind of key."""

    @property
    def frame(self) -> int:
        """The first frame that it shows in."""


Keyed = TypeVar("Keyed", bound=Keyframe)


def held(keys: Sequence[Keyed], frame: int) -> Keyed | None:
    """The key that ``frame`` shows; None before the first. ``keys`` are sorted by frame."""
    index = bisect_right(keys, frame, key=lambda key: key.frame)
    return keys[index - 1] if index else None


def following(keys: Sequence[Keyed], frame: int) -> Keyed | None:
    """The first key after ``frame``."""
    index = bisect_right(keys, frame, key=lambda key: key.frame)
    return keys[index] if index < len(keys) else None
