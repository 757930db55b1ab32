"""A case: one message, and what is expected of it."""

from __future__ import annotations

import copy
import json
from dataclasses import dataclass, field
from typing import Any

from lampblack.protocol import Sender

Tree = dict[str, Any]
"""A header's JSON object without its first member."""


@dataclass(frozen=True)
class Case:
    """One message: ``header`` is a tree, or the bytes themselves, or None for no frames."""

    name: str
    sender: Sender
    header: Tree | bytes | None
    planes: tuple[bytes, ...] = ()
    code: str = ""
    limits: dict[str, int] = field(default_factory=dict)
    frames: tuple[int, ...] = ()
    """Frames at which lights and floor are told, of a set_scene with keys."""


def compact(tree: Tree) -> bytes:
    """The header frame of a tree."""
    body = json.dumps(tree, separators=(",", ":"), ensure_ascii=False).encode()
    return b'{"lampblack":1,' + body[1:]


def patched(tree: Tree, **changes: Any) -> Tree:
    """A deep copy with some members set."""
    return {**copy.deepcopy(tree), **changes}
