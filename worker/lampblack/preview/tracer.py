"""The tracer: a thread that traces light with the renderer of previews, the most urgent first."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable, Hashable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from ..errors import RenderError, RenderRestartedError
from ..prepared import PreparedDrawing
from ..render.request import Surface
from ..render.wire import Accumulate
from ..scene import AreaLight, Canvas, Scene
from ..surface import Relief
from .contribution import LightContribution, preview_surface, surface_key
from .light_store import AccumulatedLight
from .painter import Painter
from .refinement import (
    CONVERGED,
    FIRST_AMBIENT,
    FIRST_FLOOR,
    FIRST_FLOOR_AMBIENT,
    LOW,
    MOVING,
    PASSING,
    RefinementLevel,
)
from .request import ResolvedView, ViewRequest
from .state import PreviewState

REST_SECONDS = 0.1
"""Seconds without a change after which light is refined."""
MOST_SECONDS = 0.2
"""Longest time for one light while something changes, seconds. What is shown does not wait for it,
see ``anticipation``; but the shadow on the floor does."""
TICK_SECONDS = 1.0
MAX_SURFACES = 6
MAX_FAILURES = 3


class PreviewRenderer(Protocol):
    """The renderer of a tracer; see ``RenderChild``."""

    @property
    def alive(self) -> bool: ...

    @property
    def pid(self) -> int | None: ...

    @property
    def card(self) -> str: ...

    def start(self) -> None: ...

    def accumulate(self, surface: Surface, job: Accumulate) -> tuple[NDArray[np.float32], ...]: ...

    def kill(self) -> None: ...

    def close(self) -> None: ...


@dataclass
class Tracer:
    """Traces the light of all requests: first coarse, then finer while nothing changes, then the
    light of frames that may come next.

    Args:
        renderer: the tracer closes it.
        ready: called once the renderer has loaded.
        report: receives the crash of the renderer, for all sessions with a viewport.
    """

    state: PreviewState
    painter: Painter
    renderer: PreviewRenderer
    ready: Callable[[], None]
    report: Callable[[RenderError], None]
    _surfaces: OrderedDict[Hashable, Surface] = field(default_factory=OrderedDict)
    _failures: dict[Hashable, int] = field(default_factory=dict)
    _losses: int = 0
    _pace: int = len(MOVING) - 1
    _quick: int = 0

    def run(self) -> None:
        """Trace until the state closes."""
        self._warm_up()
        while not self.state.closing:
            if not self.step():
                self._rest()
        self.renderer.close()

    def step(self) -> bool:
        """Do the most urgent piece of work; False if there is none. A crashed renderer is started
        again."""
        try:
            if not self.renderer.alive:
                raise RenderError("The renderer stopped unexpectedly.")
            return self._trace_most_urgent()
        except RenderError as error:
            self._recover(error)
        except Exception as error:  # an error of one scene must not end all previews
            self._recover(RenderError("A preview could not be made.", details=repr(error)))
        return True

    def _rest(self) -> None:
        """Wait for a change, or for the pause after a change."""
        with self.state.condition:
            if self.state.closing:
                return
            self.state.renderer = "idle"
            still = self.state.still_for()
            self.state.condition.wait(
                REST_SECONDS - still if still < REST_SECONDS else TICK_SECONDS
            )

    def _trace_most_urgent(self) -> bool:
        views = [view for view in self.state.views.values() if view.viewport.show == "lit"]
        for view in views:
            if self._show(view):
                return True
        if self.state.still_for() < REST_SECONDS:
            return False
        for level in (LOW, CONVERGED):
            for view in views:
                if self._refine(view, level):
                    return True
        return self._look_ahead(views)

    def _look_ahead(self, views: Sequence[ViewRequest]) -> bool:
        """Trace light for frames that may come next, while there is memory."""
        lights = self.state.lights
        if lights.full:
            found = [self._resolve(request) for request in (*views, *self.state.ahead)]
            lights.keep(c for _, view in filter(None, found) for c in view.contributions)
        for request in self.state.ahead:
            if not lights.full and self._refine(request, LOW):
                drawing = self.state.drawing(request.shape)
                if drawing is not None:
                    self.painter.prepare(request, drawing)
                return True
        return False

    def _show(self, request: ViewRequest) -> bool:
        """Trace light without which the request cannot be shown."""
        found = self._resolve(request)
        if found is None:
            return False
        drawing, view = found
        missing = [c for c in view.contributions if self._is_below(c, PASSING)]
        if not missing:
            return False
        surface = self._surface(drawing, view.scene)
        self.state.renderer = "working"
        for contribution in missing:
            begin = time.perf_counter()
            self._accumulate(contribution, surface, self._first_level(contribution), PASSING)
            if contribution.light is not None and contribution.subject == "character":
                self._keep_pace(time.perf_counter() - begin)
        self.painter.offer(request)
        return True

    def _refine(self, request: ViewRequest, level: int) -> bool:
        """Refine one contribution of the request to ``level``, unless something changes."""
        found = self._resolve(request)
        if found is None:
            return False
        drawing, view = found
        if level > LOW and drawing.detail == "quick":
            return False
        for contribution in view.contributions:
            if not self._is_below(contribution, level):
                continue
            self.state.renderer = "working"
            surface = self._surface(drawing, view.scene)
            if self._accumulate(contribution, surface, contribution.refinement[level - 1], level):
                self.painter.offer(request)
            return True
        return False

    def _resolve(self, request: ViewRequest) -> tuple[PreparedDrawing, ResolvedView] | None:
        """The prepared drawing and the scene on it; None if either is missing."""
        drawing = self.state.drawing(request.shape)
        view = None if drawing is None else request.resolve(drawing)
        return None if drawing is None or view is None else (drawing, view)

    def _accumulate(
        self, contribution: LightContribution, surface: Surface, how: RefinementLevel, level: int
    ) -> bool:
        """Trace ``contribution``; False if something changed before it was finished."""
        began = self.state.changes
        try:
            for first in range(0, how.spp, how.at_once):
                count = min(how.at_once, how.spp - first)
                whole = count == how.spp
                found = self.renderer.accumulate(
                    surface, contribution.accumulation(how, first, count, resolve=whole)
                )
                if level >= LOW and (self.state.changes != began or self.state.closing):
                    return False
            if not found:
                found = self.renderer.accumulate(
                    surface, contribution.accumulation(how, how.spp, 0, resolve=True)
                )
        except RenderError:
            self._failures[contribution.key] = self._failures.get(contribution.key, 0) + 1
            raise
        if level < LOW and contribution.subject == "floor":
            # So few samples leave blotches; in motion a soft shadow looks better than a ragged one.
            found = tuple(gaussian_filter(half, (0.8, 0.8, 0)) for half in found)
        first_half, second_half = found
        light = AccumulatedLight(level, how.spp, contribution.amounts, first_half, second_half)
        self.state.lights.put(contribution, light)
        self._losses = 0
        return True

    def _is_below(self, contribution: LightContribution, level: int) -> bool:
        """Whether the light is coarser than ``level``, and the renderer can refine it."""
        return (
            self.state.lights.level(contribution) < level
            and self._failures.get(contribution.key, 0) < MAX_FAILURES
        )

    def _first_level(self, contribution: LightContribution) -> RefinementLevel:
        if contribution.subject == "floor":
            return FIRST_FLOOR if contribution.light else FIRST_FLOOR_AMBIENT
        return MOVING[self._pace] if contribution.light else FIRST_AMBIENT

    def _keep_pace(self, seconds: float) -> None:
        """Choose the level of the next trace during a change by the time that this one took."""
        if seconds > MOST_SECONDS:
            self._pace, self._quick = max(0, self._pace - 1), 0
        elif seconds < MOST_SECONDS * 0.6:
            self._quick += 1
            if self._quick >= 8:
                self._pace, self._quick = min(len(MOVING) - 1, self._pace + 1), 0

    def _surface(self, drawing: PreparedDrawing, scene: Scene) -> Surface:
        key = surface_key(scene, drawing)
        if key not in self._surfaces:
            self._surfaces[key] = preview_surface(drawing, scene)
            if len(self._surfaces) > MAX_SURFACES:
                self._surfaces.popitem(last=False)
        self._surfaces.move_to_end(key)
        return self._surfaces[key]

    def _warm_up(self) -> None:
        """Start the renderer, and trace a small picture, so that everything is loaded."""
        canvas, size = Canvas(8, 8), (8, 8)
        corners = np.array([[0, 0, 0], [8, 0, 0], [0, 8, 0]], np.float32)
        relief = Relief(corners, np.array([[0, 2, 1]], np.int32))
        white = np.ones((3, 3), np.float32), np.zeros(3, np.float32), np.ones(3, np.float32)
        light = AreaLight(4, 4, 4, 4)
        job = Accumulate(canvas, (0, 0, 8, 8), size, light, None, "character", 1, 0, 1, True)
        self.state.renderer = "starting"
        try:
            self.renderer.accumulate(Surface(relief, *white), job)
        except RenderError as error:
            self._recover(error)
        self.state.renderer = "idle"
        self.ready()

    def _recover(self, error: RenderError) -> None:
        """Start the renderer again, and report it once. After repeated crashes, wait longer each
        time, so that the reports stop."""
        if self.state.closing:
            return
        self._losses += 1
        self.state.renderer = "restarting"
        if self._losses <= MAX_FAILURES:
            kind = RenderError if self._losses == MAX_FAILURES else RenderRestartedError
            self.report(kind("", details=f"{error.what} {error.details}"))
        else:
            with self.state.condition:
                self.state.condition.wait_for(
                    lambda: self.state.closing, min(30.0, 0.5 * 2 ** (self._losses - MAX_FAILURES))
                )
        with suppress(OSError):  # the next step notices this and tries again
            self.renderer.start()
