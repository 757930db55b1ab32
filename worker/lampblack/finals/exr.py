"""Multilayer OpenEXR: half float, ZIP, scene-linear, one group of channels per layer."""

from __future__ import annotations

import hashlib
import os
import struct
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import OpenEXR
from numpy.typing import NDArray

from ..atomic import atomic_path
from ..errors import LampblackError, OutputError
from ..files import open_regular, understood

STAMP = "lampblack"
DEPTH = "depth"

SEAL = "lampblackSeal"
"""The attribute with the digest of the file, in which it counts as ``_UNSEALED``."""
_UNSEALED = b"0" * 40

_MAGIC, _OTHER_LAYOUTS = 20000630, 0x1A00
_MAX_ATTRIBUTES, _MAX_ATTRIBUTE = 256, 1 << 20
_MAX_BYTES = 16 << 30

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
        SEAL: _UNSEALED.decode(),
    }
    with atomic_path(path) as temporary:
        try:
            OpenEXR.File(header, channels).write(str(temporary))
            with temporary.open("r+b") as file:
                place, _ = _read_header(file)[SEAL]
                seal = _seal_of(file, place)
                file.seek(place)
                file.write(seal)
        except RuntimeError as error:
            raise OutputError(
                f"{path} could not be written.",
                "Check that the folder exists, may be written to and has room.",
                str(error),
            ) from error


def exr_stamp(path: Path) -> str | None:
    """The stamp of an EXR of ``save_exr`` of which no bit has changed; None for anything else."""
    try:
        with open_regular(path) as file, understood(LampblackError(f"{path} is damaged.")):
            if os.fstat(file.fileno()).st_size > _MAX_BYTES:
                return None
            attributes = _read_header(file)
            place, seal = attributes[SEAL]
            return attributes[STAMP][1].decode() if _seal_of(file, place) == seal else None
    except (OSError, LampblackError):
        return None


def _seal_of(file: BinaryIO, place: int) -> bytes:
    """The digest of ``file``, whose seal is at ``place``."""
    state = hashlib.blake2b(digest_size=len(_UNSEALED) // 2)
    file.seek(0)
    state.update(file.read(place) + _UNSEALED)
    file.seek(len(_UNSEALED), 1)
    while data := file.read(1 << 20):
        state.update(data)
    return state.hexdigest().encode()


def _read_header(file: BinaryIO) -> dict[str, tuple[int, bytes]]:
    """The attributes of an OpenEXR file by name, each with its place in the file
    (https://openexr.com/en/latest/OpenEXRFileLayout.html)."""
    attributes: dict[str, tuple[int, bytes]] = {}
    magic, version = struct.unpack("<II", file.read(8))
    if magic != _MAGIC or version & _OTHER_LAYOUTS:
        raise ValueError("not an image of scan lines")
    while name := _read_name(file):
        _kind, (length,) = _read_name(file), struct.unpack("<i", file.read(4))
        if not 0 <= length <= _MAX_ATTRIBUTE or len(attributes) >= _MAX_ATTRIBUTES:
            raise ValueError(f"an attribute of {length} bytes")
        attributes[name] = file.tell(), file.read(length)
    return attributes


def _read_name(file: BinaryIO) -> str:
    name = b""
    while (letter := file.read(1)) not in (b"\0", b"") and len(name) < 256:
        name += letter
    return name.decode("ascii")
