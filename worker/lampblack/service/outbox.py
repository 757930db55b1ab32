"""The messages that wait to be sent to one client, with at most one picture, the newest."""

from __future__ import annotations

from collections import deque

Frames = list[bytes | memoryview]

MAX_WAITING = 1000


class Outbox:
    """Messages in order. A picture replaces an unsent picture."""

    def __init__(self) -> None:
        self._waiting: deque[tuple[Frames, bool]] = deque()

    def put(self, frames: Frames, *, picture: bool = False) -> None:
        """Queue a message."""
        if picture:
            self._waiting = deque(entry for entry in self._waiting if not entry[1])
        self._waiting.append((frames, picture))

    def first(self) -> Frames | None:
        """The next message to send."""
        return self._waiting[0][0] if self._waiting else None

    def sent(self) -> None:
        """Remove the first message, which was sent."""
        self._waiting.popleft()

    @property
    def overflows(self) -> bool:
        """Whether too many messages wait, because the client does not read."""
        return len(self._waiting) > MAX_WAITING
