"""Multilayer OpenEXR: half float, ZIP, scene-linear, one group of channels per layer."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import OpenEXR
from numpy.typing import NDArray

from ..atomic import atomic_path
from ..drawing.load import MAX_SIDE
from ..errors import LampblackError, OutputError
from ..files import open_regular, understood

STAMP = "lampblack"
DEPTH = "depth"

_MAGIC, _OTHER_LAYOUTS = 20000630, 0x1A00
_ZIP, _ZIP_LINES = 3, 16
"""Number of the compression, and its scan lines a block."""
_MAX_ATTRIBUTES, _MAX_ATTRIBUTE = 256, 1 << 20

Floats = NDArray[np.float32]


def save_exr(path: Path, layers: dict[str, Floats], stamp: str) -> None:
    """Write ``layers``, (H, W, 1 to 4) by name; the empty name is the picture itself.

    Channels are R, G, B, A; normals have X, Y, Z; depth has Z as 32-bit float.

    Raises:
        OutputError: it cannot be written.
    """
    channels: dict[str, NDArray[np.floating[Any]]] = {}
    for name, layer in layers.items():
        letters = {"normal": "XYZ", DEPTH: "Z"}.get(name, "RGBA")[: layer.shape[2]]
        kind = "float32" if name == DEPTH else "float16"
        for index, letter in enumerate(letters):
            plane = np.ascontiguousarray(layer[..., index]).astype(kind)
            channels[f"{name}.{letter}" if name else letter] = plane
    header = {
        "compression": OpenEXR.ZIP_COMPRESSION,
        "type": OpenEXR.scanlineimage,
        "comments": "Scene-linear, Rec. 709 primaries. Layers: see Lampblack's manual.",
        STAMP: stamp,
    }
    with atomic_path(path) as temporary:
        try:
            OpenEXR.File(header, channels).write(str(temporary))
        except RuntimeError as error:
            raise OutputError(
                f"{path} could not be written.",
                "Check that the folder exists, may be written to and has room.",
                str(error),
            ) from error


def exr_stamp(path: Path) -> str | None:
    """The stamp of a complete EXR of ``save_exr``; None for anything else."""
    try:
        with open_regular(path) as file, understood(LampblackError(f"{path} is damaged.")):
            attributes = _read_header(file)
            return attributes[STAMP].decode() if _is_whole(file, attributes) else None
    except (OSError, LampblackError):
        return None


def _read_header(file: BinaryIO) -> dict[str, bytes]:
    """The attributes of an OpenEXR file by name
    (https://openexr.com/en/latest/OpenEXRFileLayout.html)."""
    attributes: dict[str, bytes] = {}
    magic, version = struct.unpack("<II", file.read(8))
    if magic != _MAGIC or version & _OTHER_LAYOUTS:
        raise ValueError("not an image of scan lines")
    while name := _read_name(file):
        _kind, (length,) = _read_name(file), struct.unpack("<i", file.read(4))
        if not 0 <= length <= _MAX_ATTRIBUTE or len(attributes) >= _MAX_ATTRIBUTES:
            raise ValueError(f"an attribute of {length} bytes")
        attributes[name] = file.read(length)
    return attributes


def _read_name(file: BinaryIO) -> str:
    name = b""
    while (letter := file.read(1)) not in (b"\0", b"") and len(name) < 256:
        name += letter
    return name.decode("ascii")


def _is_whole(file: BinaryIO, attributes: dict[str, bytes]) -> bool:
    """Whether the blocks of scan lines follow one another to the last byte; ``file`` is at their
    table of offsets."""
    if attributes["compression"] != bytes([_ZIP]):
        return False
    _, first, _, last = struct.unpack("<4i", attributes["dataWindow"])
    count = (last - first) // _ZIP_LINES + 1
    size = file.seek(0, 1) + 8 * count
    offsets = struct.unpack(f"<{count}Q", file.read(8 * count)) if 0 < count <= MAX_SIDE else ()
    for offset in offsets:
        if offset != size:
            return False
        file.seek(offset)
        _, length = struct.unpack("<iI", file.read(8))
        size += 8 + length
    return bool(offsets) and size == file.seek(0, 2)
