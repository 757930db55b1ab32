"""The digest of a drawing, computed in the same way by both sides."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping

import numpy as np

from .planes import FORMAT_OF, Pixels, Role

DIGESTED: tuple[Role, ...] = ("pixels", "mask", "ink")


def frame_digest(planes: Mapping[Role, Pixels]) -> str:
    """BLAKE2b with a 20-byte digest and no key, as 40 lower-case hexadecimal digits.

    Its input is, for each plane there is of pixels, mask and ink, in this order: the ASCII
    line ``<role> <format> <width>x<height>`` with a final line feed, then the plane's rows
    without their padding.

    Args:
        planes: (H, W, 4) uint8 ``pixels``, (H, W) uint8 ``mask`` and ``ink``.
    """
    state = hashlib.blake2b(digest_size=20)
    for role in DIGESTED:
        if role in planes:
            pixels = planes[role]
            height, width = pixels.shape[:2]
            state.update(f"{role} {FORMAT_OF[role]} {width}x{height}\n".encode())
            state.update(np.ascontiguousarray(pixels).data)
    return state.hexdigest()
