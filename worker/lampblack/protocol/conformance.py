"""The result of a decoder, in the form in which implementations are compared."""

from __future__ import annotations

import hashlib
from typing import Any

import msgspec
import numpy as np

from .codec import Received
from .header import write_header
from .planes import Pixels


def understood(received: Received) -> dict[str, Any]:
    """The message with every default, and the BLAKE2b-160 of each plane's rows, as JSON values."""
    message = msgspec.json.decode(write_header(received.message))
    del message["lampblack"]
    planes: dict[str, Pixels] = dict(received.planes.items())
    planes |= {f"layer{index}": pixels for index, pixels in enumerate(received.layers)}
    return {
        "message": message,
        "planes": {
            role: hashlib.blake2b(np.ascontiguousarray(pixels).data, digest_size=20).hexdigest()
            for role, pixels in planes.items()
        },
    }
