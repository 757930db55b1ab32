"""The floor that catches shadows."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from msgspec import Meta

from ..affects import Affects
from .values import MAX_KEYS, Extra, KeyFrame, Pitch, Pixels


@dataclass(frozen=True)
class FloorKey:
    """A floor at one frame: each field is one of ``Floor`` that keys can change."""

    frame: KeyFrame
    y: Pixels
    pitch: Pitch = 25.0
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class Floor:
    """A shadow-catching plane hinged at the canvas line ``y``, z = 0.

    A horizontal floor is edge-on to the orthographic view, so the floor is pitched towards
    the viewer: ``pitch`` degrees, 0 edge-on, 90 a wall facing the viewer. ``keys`` move it as
    those of a light do.
    """

    y: Pixels
    pitch: Pitch = 25.0
    keys: Annotated[
        tuple[FloorKey, ...],
        Meta(max_length=MAX_KEYS, description="its values at some frames"),
        Affects.NOTHING,
    ] = ()
    extra: Extra = field(default_factory=dict)
