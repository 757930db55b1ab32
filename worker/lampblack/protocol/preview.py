"""Messages of the live preview: the scene, the viewport, and the images of it."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from ..scene import Scene
from .fields import Count, Crop, Digest, FrameNumber, ImageSide, Message, Request, Revision
from .planes import Plane

Show = Literal["lit", "normals", "relief"]


class SetScene(Message, frozen=True, kw_only=True):
    """Replace the scene. The worker keeps fields of the scene that it does not know."""

    revision: Revision
    scene: Annotated[Scene, Meta(description="the whole scene, see scene.schema.json")]


class Preview(Message, frozen=True, kw_only=True):
    """Set the viewport to a lit frame. Images follow until it is replaced or cancelled."""

    request: Request
    frame: FrameNumber
    crop: Annotated[Crop, Meta(description="the part of the frame that is in sight")]
    width: Annotated[ImageSide, Meta(description="wanted, device pixels")]
    height: Annotated[ImageSide, Meta(description="wanted, device pixels")]


class View(Message, frozen=True, kw_only=True):
    """Set the viewport to a frame's normals or relief. A client has one viewport."""

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
    """A picture for the viewport. It replaces the drawing and its ink in the whole crop.

    One plane: ``picture`` (rgba8_premultiplied), at most of the wanted size.
    """

    request: Request
    frame: FrameNumber
    digest: Annotated[Digest, Meta(description="digest of the drawing that is shown")]
    revision: Annotated[
        Count, Meta(description="revision of the scene that is shown; 0: no scene was set")
    ]
    show: Show
    pass_: Annotated[
        Count, Meta(description="rises from 0 while request, digest and revision are the same")
    ] = msgspec.field(name="pass")
    spp: Annotated[
        Count, Meta(description="samples per pixel so far; 0 if a moved light is not yet traced")
    ]
    converged: Annotated[bool, Meta(description="no finer image follows until something changes")]
    crop: Annotated[Crop, Meta(description="the part of the frame that is shown")]
    planes: Annotated[
        tuple[Plane, ...], Meta(max_length=1, description="the plane that follows")
    ] = ()
