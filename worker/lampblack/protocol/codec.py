"""Decoding and encoding: ZeroMQ frames to a message with planes, and back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import msgspec
import numpy as np

from . import checks, header
from .errors import ErrorCode, ProtocolError
from .fields import Message
from .frames import PutFrame
from .limits import LIMITS, MAX_NUMBER, Limits
from .messages import MESSAGES, Sender
from .normals import Normals
from .planes import Pixels, Plane, Role, plane_of, view_pixels
from .preview import Image
from .rigs import Rigs


class Received(NamedTuple):
    """A message that passed every check, and its planes.

    Attributes:
        message: one of ``messages.MESSAGES``.
        planes: by role, read-only views of the frames: (H, W, 4) uint8 sRGB ``pixels``
            (straight alpha) and ``picture`` (premultiplied), (H, W) uint8 ``mask`` and ``ink``.
        layers: (H, W, 4) uint8 sRGB, straight alpha, for each name in the message's ``layers``.
    """

    message: Message
    planes: dict[Role, Pixels]
    layers: tuple[Pixels, ...] = ()


def decode(
    frames: Sequence[bytes | memoryview], sender: Sender, limits: Limits = LIMITS
) -> Received:
    """Decode one multipart message. Its size is checked before anything is parsed.

    Args:
        frames: the message's frames, without any routing identity; not copied, so they must
            not change while the planes are in use.
        sender: who sent it.
        limits: how large it may be.

    Raises:
        ProtocolError: it must not be acted upon; ``code`` says why.
    """
    checks.frame_count(frames, limits)
    first, *payloads = [memoryview(frame) for frame in frames]
    checks.header_size(first, limits)
    checks.plane_bytes(payloads, limits)
    text = bytes(first)
    checks.magic(text)
    checks.version(text)
    checks.depth(text, limits)
    tree = header.parse_header(text)
    try:
        return _read(tree, payloads, sender, limits)
    except ProtocolError as error:
        error.about, error.request = _identity(tree)
        raise


def _read(
    tree: dict[str, Any], payloads: list[memoryview], sender: Sender, limits: Limits
) -> Received:
    checks.numbers(tree)
    checks.known_type(tree)
    checks.direction(tree["type"], sender)
    message = header.read_message(tree, MESSAGES[tree["type"]])
    checks.camera_inverts(message)
    checks.frame_list(message)
    planes: tuple[Plane, ...] = getattr(message, "planes", ())
    checks.plane_count(planes, payloads)
    checks.plane_roles(message, planes)
    checks.plane_formats(planes)
    checks.plane_extent(planes, limits)
    checks.plane_stride(planes)
    checks.planes_alike(planes)
    checks.plane_payload(planes, payloads)
    views = [
        (plane.role, view_pixels(plane, payload))
        for plane, payload in zip(planes, payloads, strict=True)
    ]
    pixels: dict[Role, Pixels] = {role: view for role, view in views if role != "layer"}
    layers = tuple(view for role, view in views if role == "layer")
    checks.digest(message, pixels, layers)
    return Received(message, pixels, layers)


def _identity(tree: dict[str, Any]) -> tuple[str, int | None]:
    """The type and the request number of a refused message, as far as they are usable."""
    name, request = tree.get("type"), tree.get("request")
    usable = type(request) is int and 1 <= request <= MAX_NUMBER
    return name[:40] if isinstance(name, str) else "", request if usable else None


def encode(
    message: Message,
    planes: Mapping[Role, Pixels] | None = None,
    layers: Sequence[Pixels] = (),
) -> list[bytes | memoryview]:
    """The frames of one multipart message.

    The message's own ``planes`` is filled in from the arrays, which are sent without padding.
    A contiguous array is not copied: it must not change until it is sent.

    Args:
        message: what to send; for put_frame, ``digest`` and ``layers`` must fit the arrays.
        planes: by role, in the order in which the message carries them.
        layers: of put_frame, an array for each name in its ``layers``.

    Raises:
        ProtocolError: the header would be too long (``HEADER_TOO_LARGE``).
        ValueError: an array that its role does not allow.
    """
    named = [*(planes or {}).items(), *(("layer", pixels) for pixels in layers)]
    arrays = [(role, np.ascontiguousarray(pixels)) for role, pixels in named]
    specs = tuple(plane_of(role, pixels) for role, pixels in arrays)
    if isinstance(message, PutFrame | Image | Rigs | Normals):
        message = msgspec.structs.replace(message, planes=specs)
    elif specs:
        raise ValueError(f"{type(message).__name__} carries no planes")
    first = header.write_header(message)
    if len(first) > LIMITS.header_bytes:
        raise ProtocolError(ErrorCode.HEADER_TOO_LARGE, f"{len(first)} bytes")
    return [first, *(array.data.cast("B") for _, array in arrays)]
