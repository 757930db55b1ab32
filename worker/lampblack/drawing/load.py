"""Pictures read, and PNG files written, always as sRGB with straight alpha."""

from __future__ import annotations

import io
import struct
import warnings
import zlib
from pathlib import Path
from typing import BinaryIO, TypeVar

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageOps
from PIL.BmpImagePlugin import BmpImageFile
from PIL.GifImagePlugin import GifImageFile
from PIL.ImageFile import ImageFile
from PIL.JpegImagePlugin import JpegImageFile
from PIL.PngImagePlugin import PngImageFile
from PIL.TgaImagePlugin import TgaImageFile
from PIL.TiffImagePlugin import TiffImageFile
from PIL.WebPImagePlugin import WebPImageFile

from ..atomic import atomic_file
from ..errors import DrawingError, LampblackWarning
from ..files import open_regular, read_bounded, understood
from .profile import gamma_of, to_srgb
from .sixteen_bits import fine_picture, levels_of
from .tiff import tiff_depth, unknown_tiff

MAX_SIDE = 16384
MAX_PIXELS = 40_000_000
MAX_PICTURE_BYTES = 256 << 20
"""Of a picture file: 16 bits for each of three channels, uncompressed, and some room."""
PICTURE_SUFFIXES = frozenset(
    (".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff", ".tga", ".bmp", ".gif")
)

Kind = TypeVar("Kind", bound=ImageFile)

_PNG = b"\x89PNG\r\n\x1a\n"
_FORMATS: tuple[tuple[bytes, type[ImageFile]], ...] = (
    (_PNG, PngImageFile),
    (b"\xff\xd8\xff", JpegImageFile),
    (b"RIFF", WebPImageFile),
    (b"II*\0", TiffImageFile),
    (b"MM\0*", TiffImageFile),
    (b"II+\0", TiffImageFile),
    (b"MM\0+", TiffImageFile),
    (b"GIF8", GifImageFile),
    (b"BM", BmpImageFile),
)
"""Formats by the first bytes of a file, whatever its name says."""
_ORIENTATION = 0x0112
_PLAIN_PNG = "Export it again as a PNG from your drawing program."


def load_picture(path: str | Path) -> NDArray[np.uint8]:
    """Read a picture file; see ``read_picture``.

    Raises:
        DrawingError: missing, a folder, not a picture, damaged, or too large.
    """
    return read_picture(io.BytesIO(picture_bytes(Path(path))), str(path))


def picture_bytes(path: Path) -> bytes:
    """The bytes of a picture file, at most ``MAX_PICTURE_BYTES``.

    Raises:
        DrawingError: missing, a folder, too large, or not to be read.
    """
    try:
        return read_bounded(path, MAX_PICTURE_BYTES)
    except FileNotFoundError as error:
        raise DrawingError(
            f"There is no picture at {path}.", "Check the name and the folder."
        ) from error
    except IsADirectoryError as error:
        raise DrawingError(f"{path} is a folder, not a picture.", "Name a picture file.") from error
    except PermissionError as error:
        raise DrawingError(
            f"There is no permission to read {path}.", "Check the file's permissions.", str(error)
        ) from error
    except OSError as error:
        raise DrawingError(
            f"The picture {path} cannot be read.",
            "Check its name, and that it is a file of ordinary size.",
            str(error),
        ) from error


def read_picture(file: BinaryIO, name: str) -> NDArray[np.uint8]:
    """Read a PNG, JPEG, WebP, TIFF, TGA, BMP or GIF of any colour type and depth, recognised by
    its content; ``name`` is for the errors and warnings.

    Samples become 8-bit sRGB: an ICC profile, or the gamma of a PNG, is applied; see
    ``to_srgb``. A photograph is turned upright as its EXIF orientation says. The size is
    checked before any pixel is decoded. A PNG must have one header, and every checksum must hold,
    so that a truncated file is refused.

    Returns:
        (H, W, 4) uint8, sRGB, straight alpha, row 0 at the top.

    Raises:
        DrawingError: not a picture, damaged, or too large.

    Warns:
        LampblackWarning: the file has more pictures than one; only the first is read.
    """
    try:
        with understood(_damaged(name)):
            image: ImageFile
            if file.read(len(_PNG)) == _PNG:
                depth, image = _check_png(file, name), _open_as(PngImageFile, file)
            else:
                image = _open_other(file, name)
                _check_size(*image.size, name)
                depth = tiff_depth(image, name) if isinstance(image, TiffImageFile) else 8
            frames = getattr(image, "n_frames", 1)
            if frames > 1:
                warnings.warn(
                    f"{name} holds {frames} pictures; only the first is used.",
                    LampblackWarning,
                    stacklevel=2,
                )
            if depth == 16 and image.mode in ("RGB", "RGBA"):
                gamma = gamma_of(image)
                if gamma is not None:
                    fine = fine_picture(image, lambda: _open_as(type(image), file), gamma)
                    return _upright(fine, image)
            return _decode(image, depth, name)
    except MemoryError as error:
        raise DrawingError(
            f"There is not enough memory to read {name}.", "Close other programs."
        ) from error


def whole_png_text(path: Path) -> dict[str, str]:
    """The text in a PNG whose pixels are there to the last byte; they are not decoded.

    Raises:
        DrawingError: it is no such file. OSError: it cannot be read.
    """
    with open_regular(path) as file, understood(_damaged(str(path))):
        if file.read(len(_PNG)) != _PNG:
            raise _damaged(str(path), "it is no PNG")
        _check_png(file, str(path))
        file.seek(0)
        return dict(PngImageFile(file).text)


def save_picture(path: str | Path, picture: NDArray[np.uint8]) -> None:
    """Write ``picture``, (H, W, 4) uint8 sRGB with straight alpha, as a PNG.

    The file appears whole or not at all.

    Raises:
        OutputError: the folder is missing or not writable, or the disk is full.
    """
    with atomic_file(Path(path)) as file:
        Image.fromarray(picture).save(file, "PNG", compress_level=4)


def _damaged(name: str, details: str = "") -> DrawingError:
    return DrawingError(f"The picture {name} is damaged.", _PLAIN_PNG, details)


def _check_png(file: BinaryIO, name: str) -> int:
    """Check the chunks that follow the signature: one header with a size that can be read, some
    pixels, an end, and every checksum. Returns the bits per sample."""
    depth, kind, kinds = 0, b"", set[bytes]()
    while kind != b"IEND":
        start = file.read(8)
        if len(start) < 8:
            raise _damaged(name, "it has no end")
        length, kind = struct.unpack(">I4s", start)
        if (kind == b"IHDR") == bool(kinds) or (kind == b"IHDR" and length != 13):
            raise _damaged(name, "it does not have one header")
        kinds.add(kind)
        checksum, left = zlib.crc32(kind), length
        while left:
            data = file.read(min(left, 1 << 20))
            if not data:
                raise _damaged(name, "it was cut short")
            if kind == b"IHDR":
                width, height, depth = struct.unpack(">IIB", data[:9])
                _check_size(width, height, name)
            checksum, left = zlib.crc32(data, checksum), left - len(data)
        if file.read(4) != struct.pack(">I", checksum):
            raise _damaged(name, f"the checksum of {kind!r} is wrong")
    if b"IDAT" not in kinds:
        raise _damaged(name, "it has no pixels")
    return depth


def _check_size(width: int, height: int, name: str) -> None:
    if width > MAX_SIDE or height > MAX_SIDE or width * height > MAX_PIXELS:
        raise DrawingError(
            f"The picture {name} is {width} x {height} pixels, which is too large.",
            f"At most {MAX_SIDE} a side and {MAX_PIXELS // 1_000_000} megapixels are read.",
        )


def _open_other(file: BinaryIO, name: str) -> ImageFile:
    file.seek(0)
    start = file.read(16)
    for signature, kind in _FORMATS:
        if start.startswith(signature):
            try:
                return _open_as(kind, file)
            except SyntaxError as error:  # what Pillow does not know, too
                if kind is TiffImageFile:
                    raise unknown_tiff(name, "unusual channels", str(error)) from error
                raise
    if Path(name).suffix.lower() == ".tga":  # the one format without a signature
        return _open_as(TgaImageFile, file)
    raise DrawingError(f"{name} is not a picture that can be read.", _PLAIN_PNG)


def _open_as(kind: type[Kind], file: BinaryIO) -> Kind:
    # Not Image.open: the size is checked here, and its own guard only warns.
    file.seek(0)
    return kind(file)


def _decode(image: ImageFile, depth: int, name: str) -> NDArray[np.uint8]:
    """Pillow's picture as RGBA. Corrects its handling of transparent colours (``tRNS``) of
    unusual depths, and of 16-bit grey, which ``convert`` would clip."""
    image.load()
    key = image.info.get("transparency")
    if image.mode.startswith("I"):
        grey = np.asarray(image).astype(np.uint32)
        opaque = np.ones(grey.shape, bool) if key is None else grey != key
        gamma = gamma_of(image)
        level = ((grey + 128) // 257).astype(np.uint8) if gamma is None else levels_of(gamma)[grey]
        alpha = np.where(opaque, 255, 0).astype(np.uint8)
        plain = Image.fromarray(np.dstack([level, level, level, alpha]))
        done = ("transparency", "gamma")
        plain.info = {k: v for k, v in image.info.items() if k not in done}
    else:
        if key is not None and image.mode == "RGB" and depth == 16:
            image.info["transparency"] = tuple(sample >> 8 for sample in key)
        if key is not None and image.mode == "L" and depth < 8:
            image.info["transparency"] = key * (255 // ((1 << depth) - 1))
        plain = image
    return _upright(to_srgb(plain, name), image)


def _upright(picture: Image.Image, image: ImageFile) -> NDArray[np.uint8]:
    """``picture``, which was made from ``image``, turned as the EXIF orientation of that says."""
    picture.getexif()[_ORIENTATION] = turned = image.getexif().get(_ORIENTATION, 1)
    return np.array(picture if turned == 1 else ImageOps.exif_transpose(picture))
