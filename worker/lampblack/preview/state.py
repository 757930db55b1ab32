"""What the threads of a preview share: what is wanted, and what has been made so far."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from typing import Literal

from ..drawing import DrawingPlanes
from ..prepared import Detail, PreparedDrawing
from .bounded import MIB, BoundedStore
from .light_store import LightStore
from .request import ViewRequest

RendererState = Literal["off", "starting", "idle", "working", "restarting"]
DrawingKey = tuple[str, Detail]

MAX_FAILURES = 1000


class PreviewState:
    """State behind one lock; its condition is notified when any of it changes.

    Read the attributes freely; set them by the methods.

    Args:
        clock: monotonic seconds.

    Attributes:
        views: by session, what is to be shown; viewports without a drawing are left out.
        ahead: what may be looked at next, nearest first.
        wanted: drawings to prepare, the most urgent first.
        changes: rises when something that is shown changes.
        closing: the threads shall end.
        renderer: what the renderer does; only the tracer sets it.
        planes: by digest. drawings: prepared from them. lights: traced on these.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self.condition = threading.Condition()
        self.views: Mapping[str, ViewRequest] = {}
        self.ahead: tuple[ViewRequest, ...] = ()
        self.wanted: tuple[DrawingKey, ...] = ()
        self.changes = 0
        self.closing = False
        self.renderer: RendererState = "starting"
        self.planes: BoundedStore[str, DrawingPlanes] = BoundedStore(192 * MIB)
        self.drawings: BoundedStore[DrawingKey, PreparedDrawing] = BoundedStore(320 * MIB)
        self.lights = LightStore()
        self._failures: dict[str, Exception] = {}
        self._clock = clock
        self._changed_at = 0.0

    def show(
        self,
        views: Mapping[str, ViewRequest],
        ahead: tuple[ViewRequest, ...],
        wanted: tuple[DrawingKey, ...],
    ) -> None:
        """Replace what is wanted."""
        with self.condition:
            if any(self.views.get(session) != view for session, view in views.items()):
                self.changes += 1
                self._changed_at = self._clock()
            self.views, self.ahead, self.wanted = views, ahead, wanted
            self.condition.notify_all()

    def put_planes(self, digest: str, planes: DrawingPlanes) -> None:
        """Hold the planes of a drawing."""
        with self.condition:
            self.planes.put(digest, planes, planes.nbytes)
            self.condition.notify_all()

    def fail(self, digest: str, error: Exception) -> None:
        """A drawing cannot be lit: it is not prepared again."""
        error.__cause__ = error.__context__ = None  # and no traceback: they hold large arrays
        with self.condition:
            self._failures[digest] = error.with_traceback(None)
            while len(self._failures) > MAX_FAILURES:
                self._failures.pop(next(iter(self._failures)))

    def close(self) -> None:
        """Have the threads end."""
        with self.condition:
            self.closing = True
            self.condition.notify_all()

    def failure(self, digest: str) -> Exception | None:
        """Why a drawing cannot be lit; None if nothing is known against it."""
        return self._failures.get(digest)

    def drawing(self, digest: str) -> PreparedDrawing | None:
        """A drawing in the fullest detail in which it is prepared."""
        return self.drawings.get((digest, "full")) or self.drawings.get((digest, "quick"))

    def still_for(self) -> float:
        """Seconds since something that is shown changed."""
        return self._clock() - self._changed_at
