"""The light pass cache: when some lights move, only those are traced again."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Mapping
from dataclasses import dataclass, field, replace

from ..choices import DeviceKind, GlowName
from ..scene import Scene, shining
from .passes import DARK, LightPasses, Passes

Trace = Callable[[Scene, bool, Collection[GlowName]], Passes]
"""Traces the lights of a scene, if the flag says so its ambient light, and these glows."""
Glows = Mapping[GlowName, Hashable]
"""By name, all that shapes the light of a glow beside what shapes that of a light."""


@dataclass
class LightPassCache:
    """The light passes of the last scene on the last drawing, by the geometry of each light."""

    _drawing: object = None
    _key: Hashable = None
    _lights: dict[Hashable, LightPasses] = field(default_factory=dict)
    _ambient: LightPasses | None = None
    _glows: dict[tuple[GlowName, Hashable], LightPasses | None] = field(default_factory=dict)
    _device: DeviceKind = "cpu"

    def complete(
        self, drawing: object, scene: Scene, trace: Trace, glows: Glows | None = None
    ) -> Passes:
        """The passes of ``scene`` on ``drawing``, which is compared by identity. ``trace`` is
        called for the lights that shine and are not in the cache; those that do not shine keep
        their light for later, or are dark."""
        self._forget_others(drawing, scene)
        shown = zip(scene.lights, shining(scene.lights), strict=True)
        missing = {light.geometry: light for light, shines in shown if shines}
        missing = {where: light for where, light in missing.items() if where not in self._lights}
        wanted = list((glows or {}).items())
        dark = [glow for glow in wanted if glow not in self._glows]
        if missing or dark or self._ambient is None:
            asked = replace(scene, lights=tuple(missing.values()))
            found = trace(asked, self._ambient is None, [name for name, _ in dark])
            if found.device != self._device:
                self._device = found.device
                if self._ambient is not None:  # one picture has the light of one device
                    self._ambient = None
                    return self.complete(drawing, scene, trace, glows)
            self._lights |= dict(zip(missing, found.lights, strict=True))
            self._ambient = self._ambient or found.ambient
            self._glows |= {glow: getattr(found, glow[0]) for glow in dark}
        places = [light.geometry for light in scene.lights]
        self._lights = {where: self._lights[where] for where in places if where in self._lights}
        self._glows = {glow: self._glows[glow] for glow in wanted}
        return Passes(
            tuple(self._lights.get(where, DARK) for where in places),
            self._ambient,
            **{glow[0]: self._glows[glow] for glow in wanted},
            device=self._device,
        )

    def beside_mixture(
        self, drawing: object, scene: Scene, trace: Callable[[bool], Passes]
    ) -> Passes:
        """The passes of ``scene`` with all its lights in one mixture, and its ambient light on its
        own. ``trace`` is told whether to trace the ambient light too; else it is in the cache."""
        self._forget_others(drawing, scene)
        found = trace(self._ambient is None)
        if self._ambient is not None and found.device != self._device:
            found, self._ambient = trace(True), None  # one picture has the light of one device
        if self._ambient is None:
            self._lights, self._glows = {}, {}
            self._ambient, self._device = found.ambient, found.device
        return replace(found, ambient=self._ambient)

    def _forget_others(self, drawing: object, scene: Scene) -> None:
        key = scene.render_key()
        if drawing is not self._drawing or key != self._key or self._ambient is None:
            self._lights, self._ambient, self._glows = {}, None, {}
        self._drawing, self._key = drawing, key
