"""The tracer: a thread that drives the preview renderer, the most urgent source first."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Hashable
from dataclasses import dataclass, field

import numpy as np
from scipy.ndimage import gaussian_filter

from ..errors import RenderError
from ..protocol import ErrorCode
from ..render import Expose, RenderChild, Surface
from ..scene import AreaLight, Canvas, Scene
from ..surface import Relief
from .model import Model
from .painter import Painter
from .snapshot import Snapshot
from .source import (
    CONVERGED,
    FIRST_AMBIENT,
    FIRST_FLOOR,
    FIRST_FLOOR_AMBIENT,
    LOW,
    MOVING,
    Rung,
    Source,
    sources_of,
)
from .studio import Developed, Studio

REST_SECONDS = 0.1
"""Stillness after which light is refined."""
MOST_SECONDS = 0.036
"""Longest that one light's pass should take while something changes."""
TICK_SECONDS = 1.0
MAX_SURFACES = 6
MAX_FAILURES = 3


@dataclass
class Tracer:
    """Keeps the lights of what is wanted traced: coarse at once, then finer while all is still,
    then those of the frames ahead, then nothing."""

    studio: Studio
    painter: Painter
    child: RenderChild = field(default_factory=RenderChild)
    _pace: int = len(MOVING) - 1
    _quick: int = 0
    _surfaces: OrderedDict[Hashable, Surface] = field(default_factory=OrderedDict)
    _failures: dict[Hashable, int] = field(default_factory=dict)
    _losses: int = 0

    def run(self) -> None:
        """Trace until the studio closes."""
        self._warm_up()
        while not self.studio.closing:
            try:
                self._watch_child()
                if not self._step():
                    self._rest()
            except RenderError as error:
                self._recover(error)
            except Exception as error:  # one scene's trouble must not end all previews
                self._recover(RenderError("A preview could not be made.", details=repr(error)))
        self.child.close()

    def _rest(self) -> None:
        """Wait for a change, or for the stillness after one."""
        with self.studio.condition:
            if self.studio.closing:
                return
            self.studio.preview_state = "idle"
            still = self.studio.still_for()
            self.studio.condition.wait(
                REST_SECONDS - still if still < REST_SECONDS else TICK_SECONDS
            )

    def _step(self) -> bool:
        """Do the most urgent piece of work; False if there is none."""
        looks = [
            snapshot for snapshot in self.studio.wanted.values() if snapshot.look.show == "lit"
        ]
        for snapshot in looks:
            if self._show(snapshot):
                return True
        if self.studio.still_for() < REST_SECONDS:
            return False
        for rung in (LOW, CONVERGED):
            for snapshot in looks:
                if self._refine(snapshot, rung):
                    return True
        return self._look_ahead(looks)

    def _look_ahead(self, looks: list[Snapshot]) -> bool:
        """Light the frames that may be looked at next, for as long as there is room."""
        lights = self.studio.lights
        if lights.full:
            snapshots = [*looks, *self.studio.ahead]
            models = [self.studio.model(snapshot.digest) for snapshot in snapshots]
            pairs = [(s, m) for s, m in zip(snapshots, models, strict=True) if m]
            lights.keep(source for pair in pairs for source in sources_of(*pair))
        for snapshot in self.studio.ahead:
            if not lights.full and self._refine(snapshot, LOW):
                model = self.studio.model(snapshot.digest)
                if model is not None:
                    self.painter.prepare(snapshot, model)
                return True
        return False

    def _show(self, snapshot: Snapshot) -> bool:
        """Trace whatever cannot be shown at all yet."""
        model = self.studio.model(snapshot.digest)
        if model is None or snapshot.scene is None:
            return False
        lights = self.studio.lights
        missing = [s for s in sources_of(snapshot, model) if lights.rung(s) < 0 and self._usable(s)]
        if not missing:
            return False
        surface = self._surface(model, snapshot.scene)
        self._work()
        for source in missing:
            begin = time.perf_counter()
            self._expose(source, surface, self._first_rung(source), 0)
            if source.light is not None and source.subject == "figure":
                self._keep_pace(time.perf_counter() - begin)
        self.painter.offer(snapshot)
        return True

    def _refine(self, snapshot: Snapshot, rung: int) -> bool:
        """Bring one source of the snapshot up to ``rung``, unless something else comes up."""
        model = self.studio.model(snapshot.digest)
        if model is None or snapshot.scene is None or (rung > LOW and model.grade == "coarse"):
            return False
        for source in sources_of(snapshot, model):
            if self.studio.lights.rung(source) >= rung or not self._usable(source):
                continue
            self._work()
            surface = self._surface(model, snapshot.scene)
            if self._expose(source, surface, source.ladder[rung - 1], rung):
                self.painter.offer(snapshot)
            return True
        return False

    def _expose(self, source: Source, surface: Surface, rung: Rung, level: int) -> bool:
        """Trace ``source``; False if something else came up before it was done."""
        began = self.studio.changed
        try:
            for first in range(0, rung.spp, rung.at_once):
                count = min(rung.at_once, rung.spp - first)
                whole = count == rung.spp
                found = self.child.expose(
                    surface, source.exposure(rung, first, count, develop=whole)
                )
                if level >= LOW and (self.studio.changed != began or self.studio.closing):
                    return False
            if not found:
                found = self.child.expose(surface, source.exposure(rung, rung.spp, 0, develop=True))
        except RenderError:
            self._failures[source.key] = self._failures.get(source.key, 0) + 1
            raise
        if level < LOW and source.subject == "floor":
            # So few samples leave blotches; a soft shadow moves better than a ragged one.
            found = tuple(gaussian_filter(half, (0.8, 0.8, 0)) for half in found)
        first_half, second_half = found
        light = Developed(level, rung.spp, source.amounts, first_half, second_half)
        self.studio.lights.put(source, light)
        self._losses = 0
        return True

    def _usable(self, source: Source) -> bool:
        return self._failures.get(source.key, 0) < MAX_FAILURES

    def _first_rung(self, source: Source) -> Rung:
        if source.subject == "floor":
            return FIRST_FLOOR if source.light else FIRST_FLOOR_AMBIENT
        return MOVING[self._pace] if source.light else FIRST_AMBIENT

    def _keep_pace(self, seconds: float) -> None:
        """Choose how fine the next passing trace is by how long this one took."""
        if seconds > MOST_SECONDS:
            self._pace, self._quick = max(0, self._pace - 1), 0
        elif seconds < MOST_SECONDS * 0.6:
            self._quick += 1
            if self._quick >= 8:
                self._pace, self._quick = min(len(MOVING) - 1, self._pace + 1), 0

    def _surface(self, model: Model, scene: Scene) -> Surface:
        wear = tuple(
            (material.glossy, material.gloss, material.roughness)
            for material in (
                *(scene.material(swatch.colour) for swatch in model.sheet.palette.swatches),
                scene.default_material,
            )
        )
        key = model.digest, model.grade, scene.relief_scale, wear
        if key not in self._surfaces:
            self._surfaces[key] = model.surface(scene)
            if len(self._surfaces) > MAX_SURFACES:
                self._surfaces.popitem(last=False)
        self._surfaces.move_to_end(key)
        return self._surfaces[key]

    def _work(self) -> None:
        self.studio.preview_state = "working"

    def _warm_up(self) -> None:
        """Start the renderer, and have it trace a little, so that all it needs is loaded."""
        canvas, size = Canvas(8, 8), (8, 8)
        corners = np.array([[0, 0, 0], [8, 0, 0], [0, 8, 0]], np.float32)
        relief = Relief(corners, np.array([[0, 2, 1]], np.int32))
        white = np.ones((3, 3), np.float32), np.zeros(3, np.float32), np.ones(3, np.float32)
        light = AreaLight(4, 4, 4, 4)
        job = Expose(canvas, (0, 0, 8, 8), size, light, None, "figure", 1, 0, 1, True)
        self.studio.preview_state = "starting"
        try:
            self.child.expose(Surface(relief, *white), job)
        except RenderError as error:
            self._recover(error)
        self.studio.update(preview_state="idle")

    def _watch_child(self) -> None:
        """Notice that the renderer went away while it had nothing to do."""
        if not self.child.alive and not self.studio.closing:
            raise RenderError("The renderer stopped unexpectedly.")

    def _recover(self, error: RenderError) -> None:
        """Start the renderer again and tell, once; when it is lost again and again, wait longer
        each time, so that nobody is told without end."""
        if self.studio.closing:
            return
        self._losses += 1
        self.studio.update(preview_state="restarting")
        if self._losses <= MAX_FAILURES:
            spent = self._losses == MAX_FAILURES
            code = ErrorCode.RENDER_FAILED if spent else ErrorCode.RENDER_RESTARTED
            self.studio.tell_all(code, details=f"{error.what} {error.details}")
        else:
            time.sleep(min(30.0, 0.5 * 2 ** (self._losses - MAX_FAILURES)))
        self.child.start()
