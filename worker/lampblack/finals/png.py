"""PNG finals: 8-bit sRGB with straight alpha and a stamp of their inputs."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from ..atomic import atomic_file
from ..drawing.load import whole_png_text
from ..errors import LampblackError

STAMP = "Lampblack"


def save_png(path: Path, picture: NDArray[np.uint8], stamp: str) -> None:
    """Write (H, W, 4) uint8; the file appears whole or not at all.

    Raises:
        OutputError: it cannot be written.
    """
    text = PngInfo()
    text.add_text(STAMP, stamp)
    with atomic_file(path) as file:
        Image.fromarray(picture).save(file, "PNG", compress_level=4, pnginfo=text)


def png_stamp(path: Path) -> str | None:
    """The stamp of a complete PNG; None for any other file."""
    try:
        return whole_png_text(path).get(STAMP)
    except (OSError, LampblackError):
        return None
