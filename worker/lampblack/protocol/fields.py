"""Types that fields of several messages share, with their units and ranges."""

from __future__ import annotations

from typing import Annotated

import msgspec
from msgspec import Meta

from ..scene import Colour as Colour
from .limits import MAX_NUMBER

PIXELS = {"x-unit": "px"}
BYTES = {"x-unit": "bytes"}
MILLISECONDS = {"x-unit": "ms"}

Count = Annotated[int, Meta(ge=0, le=MAX_NUMBER)]
FrameNumber = Annotated[
    int,
    Meta(ge=0, le=999_999, description="frame of the animation, in the drawing program's count"),
]
Request = Annotated[
    int, Meta(ge=1, le=MAX_NUMBER, description="number of the request, chosen by the client; rises")
]
Revision = Annotated[int, Meta(ge=1, le=MAX_NUMBER, description="revision of the scene; rises")]
Digest = Annotated[
    str,
    Meta(pattern="^[0-9a-f]{40}$", max_length=40, description="BLAKE2b-160 of a frame's planes"),
]
Name = Annotated[str, Meta(min_length=1, max_length=64)]
Sentence = Annotated[str, Meta(max_length=500)]
Capabilities = Annotated[
    tuple[Annotated[str, Meta(pattern=r"^[a-z0-9_]+$(?!\n)", max_length=32)], ...],
    Meta(max_length=32, description="optional features of the sender"),
]
ImageSide = Annotated[int, Meta(ge=1, le=4096, extra_json_schema=PIXELS)]


class Crop(msgspec.Struct, frozen=True, kw_only=True):
    """A rectangle of a frame: x right, y down, origin at the frame's top left corner."""

    x: Annotated[float, Meta(ge=-1e5, le=1e5, description="left edge", extra_json_schema=PIXELS)]
    y: Annotated[float, Meta(ge=-1e5, le=1e5, description="top edge", extra_json_schema=PIXELS)]
    width: Annotated[float, Meta(ge=0.01, le=1e5, extra_json_schema=PIXELS)]
    height: Annotated[float, Meta(ge=0.01, le=1e5, extra_json_schema=PIXELS)]


def snake_case(name: str) -> str:
    """``PutFrame`` -> ``put_frame``: a message's type is its class's name."""
    return "".join(f"_{c.lower()}" if c.isupper() else c for c in name).lstrip("_")


class Message(msgspec.Struct, frozen=True, kw_only=True, tag_field="type", tag=snake_case):
    """Base of all messages."""
