"""A live preview: its state and its threads."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Protocol

from ..drawing import Palette
from ..lasting import lasting_thread
from ..pipeline import Pipeline
from .painter import Painter, PreviewImage
from .preparer import Preparer
from .state import PreviewState
from .tracer import PreviewRenderer, Tracer


class PreviewListener(Protocol):
    """Receives the events of a preview; called from its threads."""

    def on_picture(self, image: PreviewImage) -> None:
        """A picture is ready."""

    def on_drawing(self, digest: str, palette: Palette | None, warnings: list[str]) -> None:
        """A drawing was decomposed (then with its palette), prepared, or found unusable."""

    def on_renderer_ready(self) -> None:
        """The renderer has loaded."""

    def on_preview_error(self, session: str, error: Exception) -> None:
        """There is an error with what the session shows."""


class LivePreview:
    """Prepares, traces and paints what is wanted in ``state``.

    Args:
        renderer: used only by this preview, and closed with it.
        pipeline: prepares drawings; its renderer is not used.
        clock: monotonic seconds.

    Attributes:
        threads: those that ``start`` starts.
    """

    def __init__(
        self,
        renderer: PreviewRenderer,
        pipeline: Pipeline,
        listener: PreviewListener,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.state = PreviewState(clock)
        self.renderer = renderer
        self.painter = Painter(self.state, listener.on_picture, listener.on_preview_error)
        self.tracer = Tracer(
            self.state, self.painter, renderer, listener.on_renderer_ready, self._report_to_all
        )
        self.preparer = Preparer(self.state, pipeline, listener.on_drawing)
        self._listener = listener
        self.threads = [
            lasting_thread(type(part).__name__, part.run, self._report_to_all)
            for part in (self.painter, self.tracer, self.preparer)
        ]

    def start(self) -> None:
        """Start the threads."""
        for thread in self.threads:
            thread.start()

    def stop(self) -> None:
        """Tell the threads and the renderer to end."""
        self.state.close()
        self.painter.close()
        self.renderer.kill()

    def _report_to_all(self, error: Exception) -> None:
        for session in list(self.state.views):
            self._listener.on_preview_error(session, error)
