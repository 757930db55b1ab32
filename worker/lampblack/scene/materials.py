"""Materials: how flat colours reflect light."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from msgspec import Meta

from ..affects import Affects
from ..choices import LookChoice
from .values import Extra, Strength, Unit


@dataclass(frozen=True)
class Material:
    """What a flat colour is made of: diffuse, glossy, both, or neither (left as drawn).

    ``gloss`` is the amount of the glossy lobe, ``roughness`` its width (the paper's glossy
    exponent, the other way round: 0 is a mirror, 1 is satin). ``look`` is that of the scene, or the
    colour's own: smooth, or in tones.

    ``emission`` is the light that the colour gives to everything, itself included: a flame, a
    window at night. Only the ratio of several emissions shapes the traced light.
    """

    diffuse: Annotated[
        bool, Meta(description="takes light from all sides, like paper"), Affects.COMPOSITE
    ] = True
    glossy: Annotated[bool, Meta(description="has highlights, like lacquer")] = False
    gloss: Annotated[Unit, Meta(description="amount of the highlights"), Affects.GLOSS] = 0.5
    roughness: Annotated[
        float, Meta(ge=0.02, le=1, description="width of the highlights: 0 is a mirror")
    ] = 0.3
    look: Annotated[
        LookChoice,
        Meta(description="as the scene says, always smooth, or always in tones"),
        Affects.COMPOSITE,
    ] = "scene"
    emission: Annotated[Strength, Meta(description="light that it gives"), Affects.COMPOSITE] = 0.0
    extra: Extra = field(default_factory=dict)
