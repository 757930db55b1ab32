"""The result of a decoder, in the form in which implementations are compared."""

from __future__ import annotations

import hashlib
from typing import Any

import msgspec
import numpy as np

from .codec import Received
from .header import write_header


def understood(received: Received) -> dict[str, Any]:
    """The message with every default, and the BLAKE2b-160 of each plane's rows, as JSON values."""
    message = msgspec.json.decode(write_header(received.message))
    del message["lampblack"]
    return {
        "message": message,
        "planes": {
            role: hashlib.blake2b(np.ascontiguousarray(pixels).data, digest_size=20).hexdigest()
            for role, pixels in received.planes.items()
        },
    }
