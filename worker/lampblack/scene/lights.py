"""Lights: areas of light, and the light that comes from everywhere."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass, field, replace
from typing import Annotated, Any

from msgspec import Meta

from ..affects import Affects, marks_of, traced_part
from ..choices import LightKind
from .values import (
    MAX_KEYS,
    Colour,
    Diameter,
    Extra,
    KeyFrame,
    LayerTitle,
    Pixels,
    Power,
    Strength,
    Title,
)


@dataclass(frozen=True)
class LightKey:
    """A light at one frame: each field is one of ``AreaLight`` that keys can change."""

    frame: KeyFrame
    x: Pixels
    y: Pixels
    z: Pixels
    size: Diameter = 200.0
    colour: Colour = "#ffffff"
    power: Power = 1.0
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class Pin:
    """What a light follows: the place (x, y) of the drawing that ``frame`` shows, or a layer of it
    by its name. At ``frame`` the light is where it is put; elsewhere it is displaced as the place
    or the layer is."""

    frame: KeyFrame
    x: Pixels
    y: Pixels
    layer: Annotated[str, Meta(max_length=200, description="name of a layer, or empty")] = ""
    extra: Extra = field(default_factory=dict, hash=False)


@dataclass(frozen=True)
class AreaLight:
    """A disk of light facing the paper point beneath it, or a sun.

    ``power`` 1 lights a white surface that faces it from the default height (half the
    canvas's long side) to exactly the drawn colour; light falls off with the square of the
    distance. ``z`` below 0 stands behind the paper.

    A sun shines from its place towards the middle of the canvas, and on all of it alike: with
    ``power`` 1 it lights a white surface that faces it to exactly the drawn colour, wherever that
    is. The disk as it is seen from the middle of the canvas is the sun in the sky: only its
    direction and its angle count.

    Without ``casts_shadow`` it shines through the character, onto what faces it.

    With ``colours`` or ``layers`` it lights only these flat colours and these layers of the
    character, and not the floor.

    A lamp with a ``pin`` follows the drawing from frame to frame, beside its keys. A sun does not.

    Only lights that are ``on`` shine, and only those with ``solo`` if one of them has it.

    With ``keys``, in any order, it changes from each to the next, and holds before the first and
    after the last; its own values then count for nothing. Between two keys numbers change evenly,
    colours in linear light, and any other field holds. Of keys at one frame the last counts. See
    ``timeline.py``.
    """

    x: Pixels
    y: Pixels
    z: Pixels
    size: Diameter = 200.0
    colour: Annotated[Colour, Affects.COMPOSITE] = "#ffffff"
    power: Annotated[Power, Affects.COMPOSITE] = 1.0
    kind: Annotated[
        LightKind, Meta(description="a disk at its place, or a sun whose direction counts")
    ] = "lamp"
    casts_shadow: Annotated[
        bool, Meta(description="the character throws a shadow on itself and on the floor")
    ] = True
    name: Annotated[Title, Affects.NOTHING] = ""
    on: Annotated[bool, Meta(description="it shines"), Affects.COMPOSITE] = True
    solo: Annotated[bool, Meta(description="only lights with this shine"), Affects.COMPOSITE] = (
        False
    )
    colours: Annotated[
        tuple[Colour, ...],
        Meta(max_length=64, description="the only flat colours that it lights; none: all"),
        Affects.COMPOSITE,
    ] = ()
    layers: Annotated[
        tuple[LayerTitle, ...],
        Meta(max_length=16, description="the only layers that it lights; none: all"),
        Affects.COMPOSITE,
    ] = ()
    pin: Annotated[
        Pin | None, Meta(description="what of the drawing it follows"), Affects.NOTHING
    ] = None
    keys: Annotated[
        tuple[LightKey, ...],
        Meta(max_length=MAX_KEYS, description="its values at some frames"),
        Affects.NOTHING,
    ] = ()
    extra: Extra = field(default_factory=dict)

    @property
    def geometry(self) -> Hashable:
        """All that shapes the light of power 1 in white, as it is without keys."""
        return traced_part(self)

    def neutral(self) -> AreaLight:
        """The same light as it is traced: white, of power 1, without keys."""
        kind: Any = type(self)
        bare = kind(x=0, y=0, z=0)
        untraced = {
            name: getattr(bare, name)
            for name, mark in marks_of(kind).items()
            if mark in {Affects.COMPOSITE, Affects.NOTHING}
        }
        return replace(self, **untraced)


def shining(lights: Sequence[AreaLight]) -> list[bool]:
    """For each of ``lights``, whether it shines among the others."""
    alone = any(light.on and light.solo for light in lights)
    return [light.on and (light.solo or not alone) for light in lights]


@dataclass(frozen=True)
class PaintedLight:
    """Light that the artist paints on a layer named Light: a plane above the character shines
    where the paint is, in its colour.

    With ``power`` 1 opaque white shines ten times as bright as white paper that is fully lit.
    """

    power: Annotated[Strength, Meta(description="strength of the paint"), Affects.COMPOSITE] = 1.0
    height: Annotated[
        float, Meta(ge=0.01, le=4, description="above the nearest point, half canvas sides")
    ] = 0.06
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class Ambient:
    """Light from everywhere; strength 1 alone shows an open surface in its drawn colour."""

    colour: Annotated[Colour, Affects.COMPOSITE] = "#ffffff"
    strength: Annotated[
        Strength, Meta(description="1 alone shows the drawn colours"), Affects.COMPOSITE
    ] = 0.3
    extra: Extra = field(default_factory=dict)
