"""Messages that set the scene and show it: what is looked at, and the images that follow."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from ..scene import Scene
from .fields import Count, Crop, Digest, FrameNumber, ImageSide, Message, Request, Revision
from .planes import Plane

Show = Literal["lit", "normals", "relief"]


class SetScene(Message, frozen=True, kw_only=True):
    """Replace the scene. Fields of the scene that the worker does not know are kept."""

    revision: Revision
    scene: Annotated[Scene, Meta(description="the whole scene, see scene.schema.json")]


class Preview(Message, frozen=True, kw_only=True):
    """Look at a frame, lit: images follow until this look is replaced or cancelled."""

    request: Request
    frame: FrameNumber
    crop: Annotated[Crop, Meta(description="the part of the frame that is in sight")]
    width: Annotated[ImageSide, Meta(description="wanted, device pixels")]
    height: Annotated[ImageSide, Meta(description="wanted, device pixels")]


class View(Message, frozen=True, kw_only=True):
    """Look at a frame's normals or relief instead; one look holds at a time."""

    request: Request
    frame: FrameNumber
    show: Annotated[
        Literal["normals", "relief"],
        Meta(
            description="normals: colour is (n + 1) / 2, x right, y up, z to the viewer; "
            "relief: grey, nearer is brighter"
        ),
    ]
    crop: Annotated[Crop, Meta(description="the part of the frame that is in sight")]
    width: Annotated[ImageSide, Meta(description="wanted, device pixels")]
    height: Annotated[ImageSide, Meta(description="wanted, device pixels")]


class Image(Message, frozen=True, kw_only=True):
    """A picture of a look. It replaces the drawing, ink included, in the whole of its crop.

    One plane: ``picture`` (rgba8_premultiplied), at most of the wanted size.
    """

    request: Request
    frame: FrameNumber
    digest: Annotated[Digest, Meta(description="of the drawing that is shown")]
    revision: Annotated[Count, Meta(description="of the scene that is shown; 0: none was set")]
    show: Show
    pass_: Annotated[
        Count, Meta(description="rises from 0 while request, digest and revision stay")
    ] = msgspec.field(name="pass")
    spp: Annotated[Count, Meta(description="samples per pixel so far")]
    converged: Annotated[bool, Meta(description="nothing better follows until something changes")]
    crop: Annotated[Crop, Meta(description="the part of the frame that is shown")]
    planes: Annotated[
        tuple[Plane, ...], Meta(max_length=1, description="of the frame that follows")
    ] = ()
