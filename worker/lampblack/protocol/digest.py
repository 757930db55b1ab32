"""The digest of a drawing, computed in the same way by both sides."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping

import numpy as np

from .planes import FORMAT_OF, Pixels, Role

DIGESTED: tuple[Role, ...] = ("pixels", "mask", "ink")


def frame_digest(planes: Mapping[Role, Pixels], layers: Iterable[tuple[str, Pixels]] = ()) -> str:
    """BLAKE2b with a 20-byte digest and no key, as 40 lower-case hexadecimal digits.

    Its input is, for each plane there is of pixels, mask and ink, in this order: the ASCII
    line ``<role> <format> <width>x<height>`` with a final line feed, then the plane's rows
    without their padding. Then the same for each layer, whose line ends with a blank and its
    name in UTF-8.

    Args:
        planes: (H, W, 4) uint8 ``pixels``, (H, W) uint8 ``mask`` and ``ink``.
        layers: name and (H, W, 4) uint8 pixels, bottom first.
    """
    state = hashlib.blake2b(digest_size=20)

    def add(role: Role, pixels: Pixels, name: str = "") -> None:
        height, width = pixels.shape[:2]
        state.update(f"{role} {FORMAT_OF[role]} {width}x{height}{name}\n".encode())
        state.update(np.ascontiguousarray(pixels).data)

    for role in DIGESTED:
        if role in planes:
            add(role, planes[role])
    for name, pixels in layers:
        add("layer", pixels, f" {name}")
    return state.hexdigest()
