"""OpenRaster files: the layers of one picture with their blend modes, for paint programs
(https://www.openraster.org). Bytes of sRGB with straight alpha."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Sequence
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, tostring

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..atomic import atomic_path
from ..composite.apart import Layer
from ..composite.blend import Blend
from ..errors import LampblackError
from ..files import open_regular, understood

_OPERATORS: dict[Blend, str] = {
    "normal": "svg:src-over",
    "multiply": "svg:multiply",
    "add": "svg:plus",
}
_STAMP, _END = "Lampblack ", "\n"
"""Before and after the stamp: ``zipfile`` takes a comment that was cut short."""
_THUMBNAIL_SIDE = 256


def save_ora(path: Path, layers: Sequence[Layer], merged: NDArray[np.uint8], stamp: str) -> None:
    """Write ``layers``, lowest first, and the picture that they show, (H, W, 4) uint8.

    Raises:
        OutputError: it cannot be written.
    """
    height, width = merged.shape[:2]
    image = Element("image", version="0.0.3", w=str(width), h=str(height))
    stack = SubElement(image, "stack")
    thumbnail = Image.fromarray(merged)
    thumbnail.thumbnail((_THUMBNAIL_SIDE, _THUMBNAIL_SIDE))
    with atomic_path(path) as temporary, zipfile.ZipFile(temporary, "w") as archive:
        archive.comment = f"{_STAMP}{stamp}{_END}".encode()
        # First and not compressed, so that a reader knows the file by its first bytes.
        archive.writestr("mimetype", "image/openraster")
        for name, blend, picture in reversed(layers):
            part, (left, top) = _cropped(picture)
            source = f"data/{name}.png"
            SubElement(
                stack,
                "layer",
                {
                    "name": name.replace("_", " ").capitalize(),
                    "src": source,
                    "x": str(left),
                    "y": str(top),
                    "composite-op": _OPERATORS[blend],
                },
            )
            archive.writestr(source, _png(Image.fromarray(part)))
        archive.writestr("stack.xml", tostring(image, encoding="UTF-8", xml_declaration=True))
        archive.writestr("mergedimage.png", _png(Image.fromarray(merged)))
        archive.writestr("Thumbnails/thumbnail.png", _png(thumbnail))


def ora_stamp(path: Path) -> str | None:
    """The stamp of a complete file of ``save_ora``; None for anything else."""
    try:
        with (
            open_regular(path) as file,
            understood(LampblackError(f"{path} is damaged.")),
            zipfile.ZipFile(file) as archive,
        ):
            comment = archive.comment.decode()
            own = comment.startswith(_STAMP) and comment.endswith(_END)
            own &= all(info.compress_type == zipfile.ZIP_STORED for info in archive.infolist())
            if not own or archive.testzip() is not None:
                return None
            return comment.removeprefix(_STAMP).removesuffix(_END)
    except (OSError, LampblackError):
        return None


def _cropped(picture: NDArray[np.uint8]) -> tuple[NDArray[np.uint8], tuple[int, int]]:
    """The picture without its empty margins, at least one pixel, and its corner (left, top)."""
    drawn = picture[..., 3] > 0
    rows, columns = np.flatnonzero(drawn.any(axis=1)), np.flatnonzero(drawn.any(axis=0))
    if not len(rows):
        return picture[:1, :1], (0, 0)
    part = picture[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    return np.ascontiguousarray(part), (int(columns[0]), int(rows[0]))


def _png(image: Image.Image) -> bytes:
    file = io.BytesIO()
    image.save(file, "PNG", compress_level=4)
    return file.getvalue()
