"""What waits to be sent to one client: never more than one picture, and the newest at that."""

from __future__ import annotations

from collections import deque

Frames = list[bytes | memoryview]

MAX_WAITING = 1000


class Outbox:
    """Messages in their order; a picture takes the place of one that was not sent yet."""

    def __init__(self) -> None:
        self._waiting: deque[tuple[Frames, bool]] = deque()

    def put(self, frames: Frames, *, picture: bool = False) -> None:
        """Queue a message."""
        if picture:
            self._waiting = deque(entry for entry in self._waiting if not entry[1])
        self._waiting.append((frames, picture))

    def first(self) -> Frames | None:
        """What is to be sent next."""
        return self._waiting[0][0] if self._waiting else None

    def sent(self) -> None:
        """The first message is on its way."""
        self._waiting.popleft()

    @property
    def overflows(self) -> bool:
        """Whether the client has not been reading for far too long."""
        return len(self._waiting) > MAX_WAITING
