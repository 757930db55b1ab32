"""Limits of the size of a message. They are checked before anything is parsed or allocated."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Limits:
    """Bounds of one message.

    Attributes:
        header_bytes: length of the header frame.
        planes: frames after the header.
        plane_bytes: length of each of them; also what ZMQ_MAXMSGSIZE is to be set to.
        depth: objects and arrays within one another in the header, itself included.
        side: longer side of a plane in pixels.
        pixels: pixels of a plane.
        frame_pixels: pixels of all planes of a message.
    """

    header_bytes: int = 1 << 19
    planes: int = 20
    plane_bytes: int = 1 << 28
    depth: int = 32
    side: int = 16384
    pixels: int = 40_000_000
    frame_pixels: int = 120_000_000


LIMITS = Limits()

MAX_NUMBER = (1 << 53) - 1
"""The largest magnitude of a number: above it, doubles skip integers."""
