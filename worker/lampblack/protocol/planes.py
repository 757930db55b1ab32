"""Pixel planes: the raw frames that follow a header, and their description in it."""

from __future__ import annotations

from typing import Annotated, Literal

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from .fields import BYTES, PIXELS

MAX_INT32 = (1 << 31) - 1

Pixels = NDArray[np.uint8]
Role = Literal["pixels", "mask", "ink", "picture", "layer"]
Format = Literal["rgba8", "rgba8_premultiplied", "a8"]

BYTES_PER_PIXEL: dict[Format, int] = {"rgba8": 4, "rgba8_premultiplied": 4, "a8": 1}
FORMAT_OF: dict[Role, Format] = {
    "pixels": "rgba8",
    "mask": "a8",
    "ink": "a8",
    "picture": "rgba8_premultiplied",
    "layer": "rgba8",
}


class Plane(msgspec.Struct, frozen=True, kw_only=True):
    """One raw frame: ``height`` rows of ``stride`` bytes, the top row first.

    Of each row the first ``width`` times 1 (a8) or 4 (R, G, B, A) bytes are pixels; what
    follows up to ``stride`` is padding and is ignored.
    """

    role: Annotated[Role, Meta(description="content of the plane")]
    format: Annotated[Format, Meta(description="bytes of a pixel, sRGB")]
    width: Annotated[int, Meta(ge=1, le=MAX_INT32, extra_json_schema=PIXELS)]
    height: Annotated[int, Meta(ge=1, le=MAX_INT32, extra_json_schema=PIXELS)]
    stride: Annotated[
        int,
        Meta(ge=1, le=MAX_INT32, description="from one row to the next", extra_json_schema=BYTES),
    ]

    @property
    def row_bytes(self) -> int:
        """Bytes of a row that are pixels."""
        return self.width * BYTES_PER_PIXEL[self.format]


def plane_of(role: Role, pixels: Pixels) -> Plane:
    """The description of an array that is sent without padding.

    Args:
        role: what the array shows.
        pixels: (H, W) uint8 for a mask or ink, (H, W, 4) uint8 otherwise.

    Raises:
        ValueError: another shape or dtype.
    """
    form = FORMAT_OF[role]
    size = BYTES_PER_PIXEL[form]
    if pixels.dtype != np.uint8 or pixels.shape[2:] != ((4,) if size == 4 else ()):
        raise ValueError(f"a plane of {role} cannot be {pixels.dtype} {pixels.shape}")
    height, width = pixels.shape[:2]
    return Plane(role=role, format=form, width=width, height=height, stride=width * size)


def view_pixels(plane: Plane, payload: bytes | memoryview) -> Pixels:
    """The payload as a read-only array, (H, W) or (H, W, 4) uint8, without a copy.

    The plane must have been checked: stride, size and length are trusted here.
    """
    rows = np.frombuffer(payload, np.uint8).reshape(plane.height, plane.stride)
    pixels = rows[:, : plane.row_bytes]
    if BYTES_PER_PIXEL[plane.format] == 4:
        pixels = np.lib.stride_tricks.as_strided(
            pixels, (plane.height, plane.width, 4), (plane.stride, 4, 1)
        )
    pixels.flags.writeable = False
    return pixels
