"""Contact sheets: many pictures in one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image

_GAP = 8
_PAPER = 255


def contact_sheet(rows: list[list[NDArray[np.uint8]]], cell: int = 240) -> NDArray[np.uint8]:
    """Arrange pictures on white, one row per list, each at most ``cell`` pixels on a side.

    Args:
        rows: pictures (H, W, 4) uint8, sRGB, straight alpha.

    Returns:
        (H, W, 4) uint8, opaque.
    """
    columns = max(len(row) for row in rows)
    height, width = (n * (cell + _GAP) + _GAP for n in (len(rows), columns))
    sheet = Image.new("RGBA", (width, height), (_PAPER,) * 4)
    for down, row in enumerate(rows):
        for across, picture in enumerate(row):
            image = Image.fromarray(picture)
            image.thumbnail((cell, cell), Image.Resampling.LANCZOS)
            left = _GAP + across * (cell + _GAP) + (cell - image.width) // 2
            top = _GAP + down * (cell + _GAP) + (cell - image.height) // 2
            sheet.alpha_composite(image, (left, top))
    return np.array(sheet)
