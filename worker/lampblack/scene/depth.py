"""Depth: what the artist says of the surfaces of drawings."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from msgspec import Meta

from ..choices import BodyChoice, FrontSide
from .values import Extra, KeyFrame, Pixels

MAX_HINTS, MAX_HINT_POINTS = 128, 16


@dataclass(frozen=True)
class DepthPoint:
    """A point of the canvas."""

    x: Pixels
    y: Pixels
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class DepthHint:
    """A stroke along which the artist says what is in front. It wins over what was found.

    ``front`` is the side in front for a walker from the first of ``points`` to the last, as seen
    on the canvas. Frames before and after ``frame`` use the hint too: it is carried along with
    the drawing. ``amount`` is the height of the step; 0 leaves it to the program.
    """

    frame: KeyFrame
    points: Annotated[tuple[DepthPoint, ...], Meta(max_length=MAX_HINT_POINTS)] = ()
    front: FrontSide = "left"
    amount: Annotated[
        float, Meta(ge=0, le=1, description="share of the longer side of the character's box")
    ] = 0.0
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class LayerBody:
    """What surface a layer of the drawing gets: see ``BodyChoice``."""

    layer: Annotated[str, Meta(max_length=200, description="the layer's name")]
    body: BodyChoice = "auto"
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class Depth:
    """What the artist says of the depth of drawings."""

    hints: Annotated[tuple[DepthHint, ...], Meta(max_length=MAX_HINTS)] = ()
    layers: Annotated[tuple[LayerBody, ...], Meta(max_length=64)] = ()
    extra: Extra = field(default_factory=dict)
