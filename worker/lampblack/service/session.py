"""What the worker knows of one client."""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from dataclasses import dataclass, field, replace

from ..protocol import ErrorCode, error_message
from ..protocol.fields import Message
from ..scene import Scene
from .outbox import Outbox
from .snapshot import Affine, Look, Snapshot


@dataclass(frozen=True)
class Shown:
    """What a frame shows."""

    digest: str
    camera: Affine


@dataclass
class Session:
    """One client, from its hello on.

    Attributes:
        identity: its routing identity. name: its session's name.
        frames: what each frame shows. look: what it looks at.
        request: the last request number. asked: drawings that need_frame asked for.
        palettes: requests for palettes, with their frame, that wait for a drawing.
        told: drawings whose troubles it has heard of.
    """

    identity: bytes
    name: str = field(default_factory=lambda: secrets.token_hex(16))
    outbox: Outbox = field(default_factory=Outbox)
    revision: int = 0
    scene: Scene | None = None
    frames: dict[int, Shown] = field(default_factory=dict)
    look: Look | None = None
    request: int = 0
    asked: set[str] = field(default_factory=set)
    palettes: list[tuple[int, int]] = field(default_factory=list)
    told: set[str] = field(default_factory=set)

    def snapshot(self) -> Snapshot | None:
        """What is wanted now; None without a look, or one at a frame that shows nothing."""
        return None if self.look is None else self._snapshot_of(self.look)

    def ahead(self) -> Iterator[Snapshot]:
        """What may be looked at next: the other frames, nearest first, each drawing once."""
        look = self.look
        if look is None or self.scene is None or look.frame not in self.frames:
            return
        seen = {self.frames[look.frame].digest}
        for frame in sorted(self.frames, key=lambda number: (abs(number - look.frame), number)):
            snapshot = self._snapshot_of(replace(look, frame=frame, show="lit"))
            if snapshot is not None and snapshot.digest not in seen:
                seen.add(snapshot.digest)
                yield snapshot

    def _snapshot_of(self, look: Look) -> Snapshot | None:
        shown = self.frames.get(look.frame)
        if shown is None:
            return None
        return Snapshot(self.name, look, shown.digest, shown.camera, self.revision, self.scene)

    def frame_showing(self, digest: str) -> int | None:
        """A frame that shows the drawing, the one that is looked at before others."""
        seen = self.look and self.frames.get(self.look.frame)
        if self.look and seen and seen.digest == digest:
            return self.look.frame
        return next((n for n, shown in self.frames.items() if shown.digest == digest), None)

    def rises(self, request: int) -> Message | None:
        """Take a request number; the error to answer if it does not rise."""
        if request <= self.request:
            return error_message(ErrorCode.STALE_REQUEST, request=request)
        self.request = request
        return None
