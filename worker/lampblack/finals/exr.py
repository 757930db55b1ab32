"""Multilayer OpenEXR: half float, ZIP, scene-linear, one group of channels per layer."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import OpenEXR
from numpy.typing import NDArray

from ..atomic import atomic_path
from ..errors import OutputError

STAMP = "lampblack"
DEPTH = "depth"

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
    """The stamp of an EXR; None for anything else."""
    if not path.is_file():
        return None
    try:
        with OpenEXR.File(str(path), header_only=True) as file:
            stamp = file.header().get(STAMP)
        return stamp if isinstance(stamp, str) else None
    except RuntimeError:
        return None
