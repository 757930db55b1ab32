"""Messages about drawings: which frame shows which drawing, its pixels and flat colours."""

from __future__ import annotations

from typing import Annotated

import msgspec
from msgspec import Meta

from ..choices import FrontSide
from ..shot import MAX_LAYERS
from .fields import Colour, Count, Digest, FrameNumber, Message, Request
from .planes import Plane

LayerName = Annotated[str, Meta(pattern=r"^[^\x00-\x1f\x7f]*$(?!\n)", max_length=200)]
Coefficient = Annotated[float, Meta(ge=-1e6, le=1e6)]
Affine = Annotated[
    tuple[Coefficient, Coefficient, Coefficient, Coefficient, Coefficient, Coefficient],
    Meta(description="affine map from canvas to view, 2 x 3, row by row"),
]


class PutFrame(Message, frozen=True, kw_only=True):
    """Frame ``frame`` shows the drawing ``digest``; its planes follow or were sent before.

    Without planes the worker answers need_frame if it does not hold the drawing. Planes:
    ``pixels`` (rgba8), then optionally ``mask`` and ``ink`` (a8), then a ``layer`` (rgba8) for
    each name in ``layers``, all of one size. ``pixels`` is what the layers show together. Since
    1.3 a layer named ``Light`` is light that the artist painted: it is not in ``pixels``.
    """

    frame: FrameNumber
    digest: Digest
    camera: Affine = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    planes: Annotated[
        tuple[Plane, ...], Meta(max_length=19, description="the planes that follow, in order")
    ] = ()
    layers: Annotated[
        tuple[LayerName, ...],
        Meta(
            max_length=MAX_LAYERS,
            description="names of the character's layers, bottom first, if they are sent apart",
            extra_json_schema={"x-since": "1.2"},
        ),
    ] = ()


class NeedFrame(Message, frozen=True, kw_only=True):
    """The worker needs an announced drawing that it does not hold; answered by put_frame."""

    frame: FrameNumber
    digest: Digest


class DropFrame(Message, frozen=True, kw_only=True):
    """The frame is no longer part of the animation."""

    frame: FrameNumber


class GetPalette(Message, frozen=True, kw_only=True):
    """Request the flat colours of a frame; answered by palette."""

    request: Request
    frame: FrameNumber


class Swatch(msgspec.Struct, frozen=True, kw_only=True):
    """One flat colour and its number of pixels in the fill."""

    colour: Colour
    pixels: Count


class Palette(Message, frozen=True, kw_only=True):
    """The flat colours of a frame, most used first: the keys of the scene's materials."""

    request: Request
    frame: FrameNumber
    digest: Digest
    swatches: Annotated[tuple[Swatch, ...], Meta(max_length=256)]


class GetOverlaps(Message, frozen=True, kw_only=True):
    """Request the overlaps of a frame, with the scene's hints; answered by overlaps."""

    request: Request
    frame: FrameNumber


class OverlapPoint(msgspec.Struct, frozen=True, kw_only=True):
    """A point of the canvas: x right, y down."""

    x: Annotated[float, Meta(ge=-1e6, le=1e6, description="canvas pixels")]
    y: Annotated[float, Meta(ge=-1e6, le=1e6, description="canvas pixels")]


class Overlap(msgspec.Struct, frozen=True, kw_only=True):
    """A line along which one part of the character is in front of another."""

    points: Annotated[tuple[OverlapPoint, ...], Meta(max_length=32)]
    front: Annotated[
        FrontSide,
        Meta(description="the side in front, for a walker from the first point to the last"),
    ]
    amount: Annotated[
        float, Meta(ge=0, le=1e6, description="height of the step, canvas pixels")
    ] = 0.0
    hinted: Annotated[bool, Meta(description="a hint of the scene made it so")] = False


class Overlaps(Message, frozen=True, kw_only=True):
    """The overlaps of a frame, the longest first."""

    request: Request
    frame: FrameNumber
    digest: Digest
    revision: Annotated[Count, Meta(description="revision of the scene whose hints are used")] = 0
    overlaps: Annotated[tuple[Overlap, ...], Meta(max_length=200)]
