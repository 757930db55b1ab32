"""Illumination: the weighted sum of the light of all sources on a drawing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple, get_args

import numpy as np
from numpy.typing import NDArray

from ..choices import GlowName
from ..colour import hex_linear
from ..render.passes import LightPasses, Passes
from ..scene import Scene, shining
from .form import Form
from .linking import Link
from .resample import Box
from .sums import add_up

VEIL = np.float32(0.1)
"""Share of the ambient light that glossy paint reflects: of a varnish seen from the front, 0.04."""
EMITTED = 20.0
"""Radiance of a white surface with an emission of 1, in that of one that is fully lit. It is more
than what is seen of it: a small flame is to light what is around it, and keep its colour."""
PAINT = 10.0
"""Radiance of painted white light of power 1, in that of a white surface that is fully lit: strokes
are thin."""
FAINT = np.float32(1e-3)  # avoids 0 / 0: without light there is no shadow

Floats = NDArray[np.float32]
Weighted = tuple[Floats, Floats, Floats]
"""The weight of a source, (3,) scene-linear, and its two passes, (h, w, 3): diffuse and glossy
light of the character, or the floor's light with the character and without it."""


class Source(NamedTuple):
    """A source of light: its weight, (3,) scene-linear, its passes, and what it lights; None is
    everything. A glow is light that comes from surfaces."""

    weight: Floats
    light: LightPasses
    link: Link | None = None
    is_glow: bool = False


@dataclass(frozen=True, eq=False)
class Illumination:
    """The sources of light on a drawing. Their sums are computed when they are needed.

    Attributes:
        character: the lights on the character. ambient: the ambient light on it, if it has power.
        glows: light on it that comes from surfaces.
        linked: lights that light only a part of it, by that part.
        floor: the sources on the floor, if there is one.
        openness: (h, w, 3), the ambient light of strength 1 on the character, if it was traced.
        form: the surface of the character, if it is known.
        character_area, floor_area: the part of the drawing that they cover, in its pixels; None
            is the part that the layers show.
    """

    character: Sequence[Weighted]
    ambient: Weighted | None = None
    floor: Sequence[Weighted] = ()
    openness: Floats | None = None
    character_area: Box | None = None
    floor_area: Box | None = None
    linked: Mapping[Link, Sequence[Weighted]] = field(default_factory=dict)
    glows: Sequence[Weighted] = ()
    form: Form | None = None

    @staticmethod
    def of(passes: Passes, scene: Scene, form: Form | None = None) -> Illumination:
        """The light of ``scene``, from ``passes`` of white lights that cover the whole drawing."""
        return replace(Illumination.sum_of(weigh(passes, scene), passes.ambient), form=form)

    @staticmethod
    def sum_of(sources: Sequence[Source], ambient: LightPasses | None = None) -> Illumination:
        """Light passes that cover the whole drawing, with their weights; ``ambient`` is the one
        of them that is not a light's."""
        lights: list[Weighted] = []
        glows: list[Weighted] = []
        linked: dict[Link, list[Weighted]] = {}
        around = None
        for source in sources:
            found = (source.weight, source.light.diffuse, source.light.glossy)
            if source.light is ambient:
                around = found
            elif source.link is None:
                (glows if source.is_glow else lights).append(found)
            else:
                linked.setdefault(source.link, []).append(found)
        floor = [
            (source.weight, source.light.floor, source.light.open_floor)
            for source in sources
            if source.light.floor is not None
            and source.light.open_floor is not None
            and source.link is None
        ]
        openness = None if ambient is None else ambient.diffuse
        return Illumination(lights, around, floor, openness, linked=linked, glows=glows)

    @cached_property
    def diffuse(self) -> Floats:
        """(h, w, 3) scene-linear, as in ``LightPasses``, at the size of the largest source."""
        return add_up([(weight, light) for weight, light, _ in self._sources])

    @cached_property
    def glossy(self) -> Floats:
        """(h, w, 3) scene-linear, as in ``LightPasses``, at the size of the largest source."""
        return add_up([(weight, light) for weight, _, light in self._sources])

    @cached_property
    def sheen(self) -> Floats:
        """As ``glossy``, for paint that is diffuse as well. Such paint reflects little of what is
        all around it; all of it would lie on the paint as a milky veil."""
        lights = [(weight, light) for weight, _, light in self.direct]
        if self.ambient is not None:
            weight, _, light = self.ambient
            lights.append((weight * VEIL, light))
        return add_up(lights)

    @cached_property
    def parts(self) -> list[tuple[Link, Floats, Floats]]:
        """What lights only a part of the character: that part, diffuse and glossy light, (h, w, 3)
        scene-linear."""
        return [
            (
                link,
                add_up([(weight, light) for weight, light, _ in lights]),
                add_up([(weight, light) for weight, _, light in lights]),
            )
            for link, lights in self.linked.items()
        ]

    @property
    def direct(self) -> list[Weighted]:
        """All but the ambient light on the character."""
        return [*self.character, *self.glows]

    @property
    def _sources(self) -> list[Weighted]:
        return [*self.direct, *(() if self.ambient is None else (self.ambient,))]

    @cached_property
    def floor_ratio(self) -> Floats | None:
        """(h, w, 3), the floor's light with the character divided by that without it, 1 where no
        light falls; None without a floor."""
        if not self.floor:
            return None
        cast = add_up([(weight, light) for weight, light, _ in self.floor])
        free = add_up([(weight, light) for weight, _, light in self.floor])
        return np.asarray((cast + FAINT) / (free + FAINT), np.float32)


def weigh(passes: Passes, scene: Scene) -> list[Source]:
    """The sources that shine, each with its weight: colour times power."""
    if passes.mixture is not None:
        found = [Source(np.ones(3, np.float32), passes.mixture)]
    else:
        found = [
            Source(hex_linear(light.colour) * np.float32(light.power), traced, Link.of(light))
            for light, traced, shines in zip(
                scene.lights, passes.lights, shining(scene.lights), strict=True
            )
            if shines
        ]
    ambient = hex_linear(scene.ambient.colour) * np.float32(scene.ambient.strength)
    found.append(Source(ambient, passes.ambient))
    for glow in get_args(GlowName):
        if (traced := getattr(passes, glow)) is not None:
            found.append(Source(glow_weight(glow, scene), traced, is_glow=True))
    return [source for source in found if source.weight.any()]


def glow_weight(glow: GlowName, scene: Scene) -> Floats:
    """(3,), the weight of light that comes from surfaces, as it is traced."""
    emitted, painted = scene.brightest * EMITTED, scene.painted_light.power * PAINT
    return np.full(3, emitted if glow == "emission" else painted, np.float32)
