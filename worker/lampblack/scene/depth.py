"""Depth: what the artist says of the surfaces of drawings."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Annotated

from msgspec import Meta

from ..choices import BodyChoice, Brush, FrontSide
from .values import Colour, Extra, KeyFrame, Pixels

MAX_HINTS, MAX_HINT_POINTS = 128, 16
MAX_STROKES, MAX_STROKE_POINTS = 128, 24


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
    points: Annotated[
        tuple[DepthPoint, ...], Meta(max_length=MAX_HINT_POINTS, description="of the line")
    ] = ()
    front: Annotated[FrontSide, Meta(description="the side in front; joined: neither is")] = "left"
    amount: Annotated[
        float, Meta(ge=0, le=1, description="share of the longer side of the character's box")
    ] = 0.0
    extra: Extra = field(default_factory=dict)

    def placed(
        self, points: tuple[DepthPoint, ...], scale: float = 1, *, mirrored: bool = False
    ) -> DepthHint:
        """The hint at ``points`` of another picture, which is ``scale`` times as large."""
        front = self.front
        if mirrored and front != "joined":
            front = "right" if front == "left" else "left"
        return replace(self, points=points, front=front)


@dataclass(frozen=True)
class DepthStroke:
    """A stroke of a brush that corrects the surface.

    A bump is a smooth hump along the stroke, a dent a hollow. A turn makes the surface face the way
    the stroke goes. Round and hollow say how the surface bends along the stroke: it is predicted
    again with that, and radius and amount do not matter. Frames before and after ``frame``
    have it too: it is carried along with the drawing.
    """

    frame: KeyFrame
    points: Annotated[
        tuple[DepthPoint, ...], Meta(max_length=MAX_STROKE_POINTS, description="of the stroke")
    ] = ()
    brush: Annotated[Brush, Meta(description="what the stroke does")] = "bump"
    radius: Annotated[float, Meta(ge=1, le=1e5, description="canvas pixels")] = 40.0
    amount: Annotated[
        float,
        Meta(
            ge=0,
            le=1,
            description="height of a bump or a dent as a share of its radius; of a turn, the share "
            "of a right angle by which the surface then leans",
        ),
    ] = 0.4
    extra: Extra = field(default_factory=dict)

    def placed(
        self, points: tuple[DepthPoint, ...], scale: float = 1, *, mirrored: bool = False
    ) -> DepthStroke:
        """The stroke at ``points`` of another picture, which is ``scale`` times as large."""
        return replace(self, points=points, radius=self.radius * scale)


@dataclass(frozen=True)
class DepthColour:
    """A correction of the surface of a flat colour, in all frames.

    ``volume`` multiplies how far the colour stands out from what is around it: 0 is flat, above 1
    is rounder. ``nearer`` moves it towards the viewer, or away if it is below 0.
    """

    colour: Colour
    volume: Annotated[float, Meta(ge=0, le=4, description="0 is flat, above 1 is rounder")] = 1.0
    nearer: Annotated[
        float, Meta(ge=-1, le=1, description="share of the longer side of the character's box")
    ] = 0.0
    extra: Extra = field(default_factory=dict)


Drawn = DepthHint | DepthStroke
"""What is said along a stroke, on one drawing."""
Hint = Drawn | DepthColour


@dataclass(frozen=True)
class LayerBody:
    """What surface a layer of the drawing gets."""

    layer: Annotated[str, Meta(max_length=200, description="the layer's name")]
    body: Annotated[
        BodyChoice,
        Meta(description="found; its own; part of the body below; flat on that"),
    ] = "auto"
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class Depth:
    """What the artist says of the depth of drawings."""

    hints: Annotated[
        tuple[DepthHint, ...], Meta(max_length=MAX_HINTS, description="what is in front")
    ] = ()
    layers: Annotated[
        tuple[LayerBody, ...], Meta(max_length=64, description="surfaces of layers")
    ] = ()
    strokes: Annotated[
        tuple[DepthStroke, ...], Meta(max_length=MAX_STROKES, description="of the brush")
    ] = ()
    colours: Annotated[
        tuple[DepthColour, ...], Meta(max_length=256, description="volumes of colours")
    ] = ()
    extra: Extra = field(default_factory=dict)

    @property
    def drawn(self) -> tuple[Drawn, ...]:
        """What is said along strokes, each on the drawing of its frame."""
        return *self.hints, *self.strokes
