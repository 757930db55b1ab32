"""Messages between the parent and the render process, over a pair of pipes.

A message is a little-endian 32-bit length, that many bytes of JSON, and then the raw arrays
that the JSON announces, each in C order.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterable
from typing import Annotated, Literal, Protocol

import msgspec
import numpy as np
from msgspec import Meta
from numpy.typing import NDArray

from ..choices import DeviceKind, GlowName
from ..scene import Ambient, AreaLight, Canvas, Floor
from .quality import Quality
from .spent import Activity

MAX_HEADER_BYTES = 1 << 20
MAX_ARRAY_BYTES = 1 << 32

Array = NDArray[np.float32] | NDArray[np.int32]


class WireError(Exception):
    """The other side closed the pipe or sent a malformed message."""


class Started(msgspec.Struct, tag=True):
    """The child's first message: the device that it traces on, its name, and a sentence for the
    artist if that is not what was to be expected."""

    device: DeviceKind
    name: str = ""
    notice: str = ""


class Load(msgspec.Struct, tag=True):
    """Replace the surface. Arrays: vertices, faces, albedo, gloss, roughness; then vertices, faces
    and radiance of each of ``emitters``."""

    emitters: tuple[GlowName, ...] = ()


class Mixture(msgspec.Struct, frozen=True):
    """Lights, which all cast shadows, and the ambient light, in their colours and powers."""

    lights: tuple[AreaLight, ...]
    ambient: Ambient


class Trace(msgspec.Struct, tag=True):
    """Trace one source: ``light``, or the emitter ``glow``, or ``mixture`` as one, or the ambient
    light if all are None. Answered by Traced or Failed."""

    canvas: Canvas
    view: tuple[float, float, float, float]
    light: AreaLight | None
    floor: Floor | None
    quality: Quality
    glow: GlowName | None = None
    mixture: Mixture | None = None


class Accumulate(msgspec.Struct, tag=True):
    """Trace ``count`` more samples per pixel of one source on one subject. Answered by Traced,
    with arrays if ``resolve`` is set, or Failed.

    ``first`` is the number of samples traced before with the same other fields; 0 starts again.
    """

    canvas: Canvas
    view: tuple[float, float, float, float]
    size: tuple[int, int]
    light: AreaLight | None
    floor: Floor | None
    subject: Literal["character", "floor"]
    spp: int
    first: int
    count: int
    resolve: bool
    glow: GlowName | None = None


class SaveBlend(msgspec.Struct, tag=True):
    """Write a scene to ``path``, a .blend of ``size`` pixels. Arrays: the ink, (H, W, 4) sRGB with
    straight alpha, and (V,) where the character is diffuse and where it is unlit. Answered by
    Traced without arrays, or Failed."""

    canvas: Canvas
    view: tuple[float, float, float, float]
    size: tuple[int, int]
    lights: tuple[AreaLight, ...]
    ambient: Ambient
    floor: Floor | None
    path: str


class Traced(msgspec.Struct, tag=True):
    """Arrays: diffuse, glossy and, with a floor, floor and open_floor; after Accumulate, those of
    its subject. ``spent`` are the processor seconds since the last answer."""

    spent: dict[Activity, float] = {}


class Failed(msgspec.Struct, tag=True):
    """The request failed; the child continues."""

    what: str
    details: str


Message = Started | Load | Trace | Accumulate | SaveBlend | Traced | Failed


class ArraySpec(msgspec.Struct, array_like=True):
    """Type and shape of an array that follows the header."""

    dtype: Literal["float32", "int32"]
    shape: Annotated[tuple[Annotated[int, Meta(ge=0, le=1 << 31)], ...], Meta(max_length=3)]


class Reader(Protocol):
    """The reading end of a pipe, as ``io.FileIO``."""

    def readinto(self, buffer: memoryview, /) -> int | None: ...


class Writer(Protocol):
    """The writing end of a pipe, as ``io.FileIO``; it may take a part, or nothing yet."""

    def write(self, data: memoryview, /) -> int | None: ...


def send(stream: Writer, message: Message, arrays: Iterable[Array] = ()) -> None:
    """Write one message.

    Raises:
        OSError: the pipe is broken.
    """
    sent = [np.ascontiguousarray(array) for array in arrays]
    specs = [(array.dtype.name, array.shape) for array in sent]
    header = msgspec.json.encode((message, specs))
    _write(stream, memoryview(struct.pack("<I", len(header)) + header))
    for array in sent:
        if array.size:
            _write(stream, array.data.cast("B"))


def receive(stream: Reader) -> tuple[Message, list[Array]]:
    """Read one message and its arrays.

    Raises:
        WireError: the pipe closed, or the message is malformed or too large.
    """
    (length,) = struct.unpack("<I", _read(stream, bytearray(4)))
    if length > MAX_HEADER_BYTES:
        raise WireError(f"a header of {length} bytes")
    try:
        message, specs = msgspec.json.decode(
            _read(stream, bytearray(length)), type=tuple[Message, list[ArraySpec]]
        )
    except msgspec.DecodeError as error:
        raise WireError(str(error)) from error
    arrays: list[Array] = []
    for spec in specs:
        if math.prod(spec.shape) * 4 > MAX_ARRAY_BYTES:
            raise WireError(f"an array of shape {spec.shape}")
        array: Array = np.zeros(spec.shape, spec.dtype)
        if array.size:
            _read(stream, array.data.cast("B"))
        arrays.append(array)
    return message, arrays


def _write(stream: Writer, data: memoryview) -> None:
    while data:
        data = data[stream.write(data) or 0 :]


def _read(stream: Reader, buffer: bytearray | memoryview) -> bytearray | memoryview:
    rest = memoryview(buffer)
    while rest:
        count = stream.readinto(rest)
        if not count:
            raise WireError("the pipe closed")
        rest = rest[count:]
    return buffer
