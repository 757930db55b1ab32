"""The exposure sheet of a project: what its layers show in each frame."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from ..cache import digest
from .document import Key, Layer

Identify = Callable[[Layer, Key], bytes]


class Shown(NamedTuple):
    """``identity``: a digest of what is shown. ``drawn``: how many layers show something."""

    identity: str
    drawn: int


def shown(layers: Sequence[Layer], length: int, identify: Identify) -> list[Shown]:
    """What ``layers``, bottom first, show in frames 1 to ``length``. ``identify`` is called once
    for each key that is not blank."""
    changes = sorted(
        (max(1, key.frame), number, index)
        for index, layer in enumerate(layers)
        for number, key in enumerate(layer.keys)
        if key.frame <= length
    )
    parts = [b""] * len(layers)
    frames: list[Shown] = []
    now = Shown(digest(), 0)
    for place, (frame, number, index) in enumerate(changes):
        frames += [now] * (frame - 1 - len(frames))
        layer = layers[index]
        key = layer.keys[number]
        parts[index] = b"" if key.blank else identify(layer, key)
        if place + 1 == len(changes) or changes[place + 1][0] != frame:
            now = Shown(digest(*filter(None, parts)), sum(map(bool, parts)))
    return frames + [now] * (length - len(frames))
