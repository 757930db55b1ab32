"""The rules for a message, one function each; ``codec`` calls them in this order.

Each raises ``ProtocolError`` with the code of its rule, and each has a vector that only it
refuses (``protocol/vectors/reject``).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import Any

from ..drawing.sequence import parse_frames
from ..errors import DrawingError
from .digest import frame_digest
from .errors import ErrorCode, ProtocolError
from .fields import Message
from .frames import PutFrame
from .job import Render
from .limits import MAX_NUMBER, Limits
from .messages import BY_SENDER, MESSAGES, Sender
from .normals import Normals
from .planes import FORMAT_OF, Pixels, Plane, Role
from .preview import Image
from .rigs import Rigs
from .version import MAGIC, PREFIX

_ROLES: dict[type[Message], tuple[tuple[Role, ...], ...]] = {
    PutFrame: (
        (),
        ("pixels",),
        ("pixels", "mask"),
        ("pixels", "ink"),
        ("pixels", "mask", "ink"),
    ),
    Image: (("picture",),),
    Rigs: (("picture",),),
    Normals: (("picture",),),
}
_BRACKET_OR_STRING = re.compile(rb'[\[{]|[\]}]|"(?:[^"\\]|\\.)*+"?', re.DOTALL)


def frame_count(frames: Sequence[bytes | memoryview], limits: Limits) -> None:
    """A header and not too many planes."""
    if not 1 <= len(frames) <= 1 + limits.planes:
        raise ProtocolError(ErrorCode.BAD_FRAME_COUNT, f"{len(frames)} frames")


def header_size(header: memoryview, limits: Limits) -> None:
    """The header is not too long."""
    if header.nbytes > limits.header_bytes:
        raise ProtocolError(ErrorCode.HEADER_TOO_LARGE, f"{header.nbytes} bytes")


def plane_bytes(payloads: Sequence[memoryview], limits: Limits) -> None:
    """No plane is too long."""
    for payload in payloads:
        if payload.nbytes > limits.plane_bytes:
            raise ProtocolError(ErrorCode.PLANE_TOO_LARGE, f"{payload.nbytes} bytes")


def magic(header: bytes) -> None:
    """The header begins with the bytes of every Lampblack header."""
    if not header.startswith(MAGIC):
        raise ProtocolError(ErrorCode.NOT_LAMPBLACK, repr(header[: len(MAGIC)]))


def version(header: bytes) -> None:
    """The major version is this one."""
    if not header.startswith(PREFIX):
        theirs = header[len(MAGIC) :].split(b",")[0][:8]
        raise ProtocolError(ErrorCode.VERSION_MISMATCH, f"major version {theirs!r}")


def depth(header: bytes, limits: Limits) -> None:
    """Brackets outside strings are not nested too deep for a parser, even if malformed."""
    level = 0
    for match in _BRACKET_OR_STRING.finditer(header):
        token = match[0]
        level += (token in b"[{") - (token in b"]}")
        if level > limits.depth:
            raise ProtocolError(ErrorCode.TOO_DEEP, f"at byte {match.start()}")


def numbers(value: Any, path: str = "$") -> None:
    """Every number has the same value as a double and as a 64-bit integer."""
    if isinstance(value, dict):
        for key, item in value.items():
            numbers(item, f"{path}.{key[:40]}")
    elif isinstance(value, list):
        for index, item in enumerate(value):
            numbers(item, f"{path}[{index}]")
    elif isinstance(value, int | float) and not abs(value) <= MAX_NUMBER:
        raise ProtocolError(ErrorCode.BAD_NUMBER, f"at {path}"[:200])


def known_type(tree: dict[str, Any]) -> None:
    """The type is a string that names a message."""
    name = tree.get("type")
    if not (isinstance(name, str) and name in MESSAGES):
        raise ProtocolError(ErrorCode.UNKNOWN_TYPE, f"type {name!r}"[:200])


def direction(name: str, sender: Sender) -> None:
    """The sender may send this type."""
    if name not in BY_SENDER[sender]:
        raise ProtocolError(ErrorCode.WRONG_DIRECTION, f"{name} from the {sender}")


def camera_inverts(message: Message) -> None:
    """The camera matrix can be inverted."""
    if isinstance(message, PutFrame):
        a, b, _, c, d, _ = message.camera
        if abs(a * d - b * c) < 1e-6:
            raise ProtocolError(ErrorCode.BAD_VALUE, "the camera matrix has no inverse")


def frame_list(message: Message) -> None:
    """The ranges of a job run forwards and name a bounded number of frames."""
    if isinstance(message, Render):
        try:
            numbers = parse_frames(message.frames)
        except DrawingError as error:
            raise ProtocolError(ErrorCode.BAD_VALUE, error.what) from error
        if numbers[0] < 0:
            raise ProtocolError(ErrorCode.BAD_VALUE, f"{numbers[0]} is not a frame of an animation")


def plane_count(planes: Sequence[Plane], payloads: Sequence[memoryview]) -> None:
    """The number of planes is the announced one."""
    if len(planes) != len(payloads):
        raise ProtocolError(
            ErrorCode.BAD_PLANE_COUNT, f"{len(planes)} announced, {len(payloads)} came"
        )


def plane_roles(message: Message, planes: Sequence[Plane]) -> None:
    """The planes are those that the message may carry, in their order; there is one for each
    layer."""
    roles = tuple(plane.role for plane in planes)
    layers = tuple("layer" for _ in getattr(message, "layers", ()))
    allowed = _ROLES.get(type(message), ((),))
    if roles not in [(*others, *layers) for others in allowed if others or not layers]:
        raise ProtocolError(ErrorCode.BAD_PLANE, f"roles {', '.join(roles)}")


def plane_formats(planes: Sequence[Plane]) -> None:
    """Each role has its format."""
    for plane in planes:
        if plane.format != FORMAT_OF[plane.role]:
            raise ProtocolError(ErrorCode.BAD_PLANE, f"{plane.role} as {plane.format}")


def plane_extent(planes: Sequence[Plane], limits: Limits) -> None:
    """No side and no area exceeds that of drawings, and all planes together are not too large."""
    for plane in planes:
        width, height = plane.width, plane.height
        if max(width, height) > limits.side or width * height > limits.pixels:
            raise ProtocolError(ErrorCode.IMAGE_TOO_LARGE, f"{width} x {height}")
    together = sum(plane.width * plane.height for plane in planes)
    if together > limits.frame_pixels:
        raise ProtocolError(ErrorCode.IMAGE_TOO_LARGE, f"{together} pixels in all planes")


def plane_stride(planes: Sequence[Plane]) -> None:
    """A row's pixels fit into its stride."""
    for plane in planes:
        if plane.stride < plane.row_bytes:
            raise ProtocolError(
                ErrorCode.BAD_PLANE, f"stride {plane.stride} below {plane.row_bytes}"
            )


def planes_alike(planes: Sequence[Plane]) -> None:
    """The planes of a frame have the same size."""
    if len({(plane.width, plane.height) for plane in planes}) > 1:
        raise ProtocolError(ErrorCode.BAD_PLANE, "planes of several sizes")


def plane_payload(planes: Sequence[Plane], payloads: Sequence[memoryview]) -> None:
    """Each plane has exactly stride times height bytes, computed in 64 bits."""
    for plane, payload in zip(planes, payloads, strict=False):
        if payload.nbytes != plane.stride * plane.height:
            raise ProtocolError(
                ErrorCode.PLANE_SIZE_MISMATCH,
                f"{payload.nbytes} bytes for {plane.stride} x {plane.height}",
            )


def digest(message: Message, pixels: dict[Role, Pixels], layers: Sequence[Pixels] = ()) -> None:
    """The digest is that of the planes."""
    if isinstance(message, PutFrame) and pixels:
        found = frame_digest(pixels, zip(message.layers, layers, strict=True))
        if found != message.digest:
            raise ProtocolError(ErrorCode.DIGEST_MISMATCH, f"the planes have {found}")


CHECKS: tuple[Callable[..., None], ...] = (
    frame_count,
    header_size,
    plane_bytes,
    magic,
    version,
    depth,
    numbers,
    known_type,
    direction,
    camera_inverts,
    frame_list,
    plane_count,
    plane_roles,
    plane_formats,
    plane_extent,
    plane_stride,
    planes_alike,
    plane_payload,
    digest,
)
