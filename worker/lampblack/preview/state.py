"""The state that the threads of a preview share: what is wanted, and what is made so far."""

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
from .shape import DrawingShape

RendererState = Literal["off", "starting", "idle", "working", "restarting"]
DrawingKey = tuple[DrawingShape, Detail]

MAX_FAILURES = 1000


class PreviewState:
    """State with one lock. Its condition is notified of every change.

    Read the attributes directly, and change them by the methods.

    Args:
        clock: monotonic seconds.

    Attributes:
        views: view requests by session; viewports without a drawing are omitted.
        ahead: view requests that may come next, nearest first.
        wanted: drawings to prepare, the most urgent first.
        changes: a count that rises when something visible changes.
        closing: whether the threads are to end.
        renderer: state of the renderer; only the tracer sets it.
        planes: pixel planes by digest. drawings: prepared drawings. lights: traced light.
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
        """Store the planes of a drawing."""
        with self.condition:
            self.planes.put(digest, planes, planes.nbytes)
            self.condition.notify_all()

    def fail(self, digest: str, error: Exception) -> None:
        """Mark a drawing that cannot be lit, so that it is not prepared again."""
        error.__cause__ = error.__context__ = (
            None  # without traceback, which would keep large arrays
        )
        with self.condition:
            self._failures[digest] = error.with_traceback(None)
            while len(self._failures) > MAX_FAILURES:
                self._failures.pop(next(iter(self._failures)))

    def close(self) -> None:
        """Tell the threads to end."""
        with self.condition:
            self.closing = True
            self.condition.notify_all()

    def failure(self, digest: str) -> Exception | None:
        """Why a drawing cannot be lit; None if no reason is known."""
        return self._failures.get(digest)

    def drawing(self, shape: DrawingShape) -> PreparedDrawing | None:
        """A prepared drawing in the fullest detail so far."""
        return self.drawings.get((shape, "full")) or self.drawings.get((shape, "quick"))

    def is_prepared(self, digest: str, *details: Detail) -> bool:
        """Whether a drawing is prepared, whatever the artist says of its depth; in any of
        ``details``, or in any detail at all."""
        return any(
            shape.digest == digest and (not details or detail in details)
            for shape, detail in self.drawings.keys()  # noqa: SIM118 (no mapping)
        )

    def still_for(self) -> float:
        """Seconds since something visible changed."""
        return self._clock() - self._changed_at
