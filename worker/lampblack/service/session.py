"""What the worker knows of one client."""

from __future__ import annotations

import secrets
from collections.abc import Hashable, Iterator
from dataclasses import dataclass, field, replace

from ..camera import Affine
from ..protocol import ErrorCode, error_message
from ..protocol.fields import Message
from ..scene import Scene
from ..timeline import is_keyed, scene_at
from .outbox import Outbox
from .snapshot import Look, Snapshot


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
        """What may be looked at next: the other frames, nearest first, each sight once."""
        look = self.look
        if look is None or self.scene is None or look.frame not in self.frames:
            return
        seen = {self.sight(look.frame)}
        for frame in sorted(self.frames, key=lambda number: (abs(number - look.frame), number)):
            snapshot = self._snapshot_of(replace(look, frame=frame, show="lit"))
            if snapshot is not None and self.sight(frame) not in seen:
                seen.add(self.sight(frame))
                yield snapshot

    def sight(self, frame: int) -> Hashable:
        """The same for frames that look alike: by their drawing, unless the light is keyed."""
        digest = self.frames[frame].digest
        return (digest, frame) if self.scene is not None and is_keyed(self.scene) else digest

    def _snapshot_of(self, look: Look) -> Snapshot | None:
        shown = self.frames.get(look.frame)
        if shown is None:
            return None
        scene = None if self.scene is None else scene_at(self.scene, look.frame)
        return Snapshot(self.name, look, shown.digest, shown.camera, self.revision, scene)

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
