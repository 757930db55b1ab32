"""PNG files read and written, always as sRGB with straight alpha."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from PIL.PngImagePlugin import PngImageFile

from ..atomic import atomic_file
from ..errors import DrawingError

MAX_SIDE = 16384
MAX_PIXELS = 40_000_000

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_PLAIN_PNG = "Export it again as a PNG from your drawing program."


def load_picture(path: str | Path) -> NDArray[np.uint8]:
    """Read a PNG file; see ``read_picture``.

    Raises:
        DrawingError: missing, a folder, not a PNG, damaged, or too large.
    """
    path = Path(path)
    try:
        with path.open("rb") as file:
            return read_picture(file, str(path))
    except FileNotFoundError as error:
        raise DrawingError(
            f"There is no picture at {path}.", "Check the name and the folder."
        ) from error
    except IsADirectoryError as error:
        raise DrawingError(f"{path} is a folder, not a picture.", "Name a PNG file.") from error
    except PermissionError as error:
        raise DrawingError(
            f"There is no permission to read {path}.", "Check the file's permissions.", str(error)
        ) from error


def read_picture(file: BinaryIO, name: str) -> NDArray[np.uint8]:
    """Read a PNG of any colour type and depth; ``name`` is for the errors.

    16-bit samples become 8-bit ones. The size is checked from the header, before any pixel is
    decoded. Every chunk's checksum must hold, so that a truncated file is refused.

    Returns:
        (H, W, 4) uint8, sRGB, straight alpha, row 0 at the top.

    Raises:
        DrawingError: not a PNG, damaged, or too large.
    """
    try:
        depth = _check_header(file, name)
        _open_png(file).verify()
        return _decode(_open_png(file), depth)
    except (OSError, SyntaxError, ValueError, struct.error, EOFError) as error:
        raise DrawingError(f"The PNG {name} is damaged.", _PLAIN_PNG, str(error)) from error
    except MemoryError as error:
        raise DrawingError(
            f"There is not enough memory to read {name}.", "Close other programs."
        ) from error


def save_picture(path: str | Path, picture: NDArray[np.uint8]) -> None:
    """Write ``picture``, (H, W, 4) uint8 sRGB with straight alpha, as a PNG.

    The file appears whole or not at all.

    Raises:
        OutputError: the folder is missing or not writable, or the disk is full.
    """
    with atomic_file(Path(path)) as file:
        Image.fromarray(picture).save(file, "PNG", compress_level=4)


def _check_header(file: BinaryIO, name: str) -> int:
    """Check the signature and the size. Returns the bits per sample."""
    header = file.read(29)
    if header[:8] != _SIGNATURE:
        raise DrawingError(f"{name} is not a PNG picture.", _PLAIN_PNG)
    if len(header) < 29 or header[12:16] != b"IHDR":
        raise DrawingError(f"The PNG {name} is damaged.", _PLAIN_PNG)
    width, height, depth = struct.unpack(">IIB", header[16:25])
    if width > MAX_SIDE or height > MAX_SIDE or width * height > MAX_PIXELS:
        raise DrawingError(
            f"The picture {name} is {width} x {height} pixels, which is too large.",
            f"At most {MAX_SIDE} a side and {MAX_PIXELS // 1_000_000} megapixels are read.",
        )
    return int(depth)


def _open_png(file: BinaryIO) -> PngImageFile:
    # Not Image.open: the size is checked already, and its own guard only warns.
    file.seek(0)
    return PngImageFile(file)


def _decode(image: PngImageFile, depth: int) -> NDArray[np.uint8]:
    """Pillow's picture as RGBA. Corrects its handling of transparent colours (``tRNS``) of
    unusual depths, and of 16-bit grey, which ``convert`` would clip."""
    image.load()
    key = image.info.get("transparency")
    if image.mode.startswith("I"):
        grey = np.asarray(image).astype(np.uint32)
        opaque = np.ones(grey.shape, bool) if key is None else grey != key
        level = ((grey + 128) // 257).astype(np.uint8)
        alpha = np.where(opaque, 255, 0).astype(np.uint8)
        return np.dstack([level, level, level, alpha])
    if key is not None and image.mode == "RGB" and depth == 16:
        image.info["transparency"] = tuple(sample >> 8 for sample in key)
    if key is not None and image.mode == "L" and depth < 8:
        image.info["transparency"] = key * (255 // ((1 << depth) - 1))
    return np.array(image.convert("RGBA"))
