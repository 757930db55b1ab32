"""Messages about rigs: lights to use again, shown on the drawing."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from .fields import Digest, FrameNumber, Message, Request
from .planes import Plane

MAX_RIGS = 24
RigText = Annotated[
    str,
    Meta(
        pattern=r"^\{[^\x00]*\}$(?!\n)",
        max_length=1 << 14,
        description="JSON, as in the file of a rig",
    ),
]
RigName = Annotated[str, Meta(pattern=r"^[^\x00-\x1f\x7f]*$(?!\n)", max_length=80)]


class GetRigs(Message, frozen=True, kw_only=True):
    """Request rigs with their pictures on a frame's drawing; answered by rigs.

    First come the rigs that the worker has, if ``presets`` is set; they are placed on the figure.
    Then come those in ``rigs``, placed on the whole canvas: files of the artist, or the scene's
    own light with another look.
    """

    request: Request
    frame: FrameNumber
    side: Annotated[int, Meta(ge=16, le=256, description="side of a picture, pixels")] = 96
    presets: bool = True
    rigs: Annotated[tuple[RigText, ...], Meta(max_length=12)] = ()


class Rigs(Message, frozen=True, kw_only=True):
    """Rigs, in pixels of the scene's canvas: to use one, copy its fields into the scene.

    One plane: ``picture`` (rgba8_premultiplied), with a square picture for each rig, one below the
    other. The pictures are sketches without bounced light, made in a moment.
    """

    request: Request
    frame: FrameNumber
    digest: Annotated[Digest, Meta(description="digest of the drawing that is shown")]
    names: Annotated[
        tuple[RigName, ...],
        Meta(max_length=MAX_RIGS, description="names of the worker's rigs; empty for others"),
    ]
    rigs: Annotated[tuple[RigText, ...], Meta(max_length=MAX_RIGS)]
    planes: Annotated[
        tuple[Plane, ...], Meta(max_length=1, description="the plane that follows")
    ] = ()
