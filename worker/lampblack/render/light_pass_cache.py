"""The light pass cache: when some lights move, only those are traced again."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field, replace

from ..scene import Scene, shining
from .passes import DARK, LightPasses, Passes

Trace = Callable[[Scene, bool], Passes]
"""Traces the lights of a scene and, if the flag says so, its ambient light."""


@dataclass
class LightPassCache:
    """The light passes of the last scene on the last drawing, by the geometry of each light."""

    _drawing: object = None
    _key: Hashable = None
    _lights: dict[Hashable, LightPasses] = field(default_factory=dict)
    _ambient: LightPasses | None = None

    def complete(self, drawing: object, scene: Scene, trace: Trace) -> Passes:
        """The passes of ``scene`` on ``drawing``, which is compared by identity. ``trace`` is
        called for the lights that shine and are not in the cache; those that do not shine keep
        their light for later, or are dark."""
        key = scene.render_key()
        if drawing is not self._drawing or key != self._key:
            self._lights, self._ambient = {}, None
        shown = zip(scene.lights, shining(scene.lights), strict=True)
        missing = {light.geometry: light for light, shines in shown if shines}
        missing = {where: light for where, light in missing.items() if where not in self._lights}
        if missing or self._ambient is None:
            asked = replace(scene, lights=tuple(missing.values()))
            found = trace(asked, self._ambient is None)
            self._lights |= dict(zip(missing, found.lights, strict=True))
            self._ambient = self._ambient or found.ambient
        self._drawing, self._key = drawing, key
        places = [light.geometry for light in scene.lights]
        self._lights = {where: self._lights[where] for where in places if where in self._lights}
        return Passes(tuple(self._lights.get(where, DARK) for where in places), self._ambient)
