"""Messages about normals: a small picture of them, to shade a drawing with before it is lit."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from .fields import Digest, FrameNumber, Message, Request
from .planes import Plane


class GetNormals(Message, frozen=True, kw_only=True):
    """Request the normals of a frame's drawing; answered by normals. Since 1.3."""

    request: Request
    frame: FrameNumber
    side: Annotated[int, Meta(ge=16, le=512, description="longer side of the picture")] = 160


class Normals(Message, frozen=True, kw_only=True):
    """The normals of a drawing, in the detail that is prepared at this moment. Since 1.3.

    One plane: ``picture`` (rgba8_premultiplied) of the whole drawing, opaque in the character: its
    colour is (n + 1) / 2, x right, y up, z to the viewer.
    """

    request: Request
    frame: FrameNumber
    digest: Annotated[Digest, Meta(description="digest of the drawing")]
    planes: Annotated[
        tuple[Plane, ...], Meta(max_length=1, description="the plane that follows")
    ] = ()
