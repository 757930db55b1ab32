"""Pixels of Krita's layers: tiles, compressed by LZF.

Source: ``KisTiledDataManager::write`` and ``KisTileCompressor2`` of Krita. A header in text gives
the size of tiles and pixels and the number of tiles; each tile begins with a line of its place and
length. A compressed tile has all samples of a channel together.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled

Bytes = NDArray[np.uint8]

SIDE = 64
_HEADER = re.compile(
    rb"VERSION 2\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE (\d{1,2})\nDATA (\d{1,7})\n"
)
_TILE = re.compile(rb"(-?\d{1,7}),(-?\d{1,7}),LZF,(\d{1,6})\n")


def unpacked(
    data: bytes | memoryview, size: tuple[int, int], place: tuple[int, int], default: bytes
) -> Bytes:
    """(H, W, samples) uint8: the part of a layer on a canvas of ``size`` (width, height).

    Args:
        data: the layer's file.
        place: (x, y) of the layer's origin on the canvas.
        default: the pixel where there is no tile.

    Raises:
        ValueError: the file is damaged, or its pixels are not as large as ``default``.
    """
    header = _HEADER.match(data)
    if header is None or int(header[1]) != len(default):
        raise ValueError("unknown header")
    width, height = size
    samples = len(default)
    whole = np.empty((height, width, samples), np.uint8)
    whole[:] = np.frombuffer(default, np.uint8)
    at = header.end()
    for _ in range(int(header[2])):
        tile = _TILE.match(data, at)
        if tile is None:
            raise ValueError("a tile is missing")
        at, end = tile.end(), tile.end() + int(tile[3])
        left, top = int(tile[1]) + place[0], int(tile[2]) + place[1]
        x, y = max(0, left), max(0, top)
        part = whole[y : max(0, top + SIDE), x : max(0, left + SIDE)]
        if part.size:
            pixels = _tile(np.frombuffer(data[at:end], np.uint8), samples)
            part[:] = pixels[y - top :, x - left :][: part.shape[0], : part.shape[1]]
        at = end
    return whole


def _tile(packed: Bytes, samples: int) -> Bytes:
    """(64, 64, samples) the pixels of a tile."""
    length = SIDE * SIDE * samples
    if not len(packed):
        raise ValueError("an empty tile")
    if packed[0] == 0:
        if len(packed) != length + 1:
            raise ValueError("a tile of a wrong size")
        return packed[1:].reshape(SIDE, SIDE, samples)
    planes = np.empty(length, np.uint8)
    if _inflate(packed[1:], planes) != length:
        raise ValueError("a tile cannot be unpacked")
    return planes.reshape(samples, SIDE, SIDE).transpose(1, 2, 0)


@compiled
def _inflate(packed: Bytes, out: Bytes) -> int:
    """Unpack LZF (liblzf, as Krita has it). Returns the number of bytes; -1 if it is damaged."""
    at, end, place, room = 0, len(packed), 0, len(out)
    while at < end:
        control = int(packed[at])
        at += 1
        if control < 32:
            count = control + 1
            if at + count > end or place + count > room:
                return -1
            for _ in range(count):
                out[place] = packed[at]
                place += 1
                at += 1
            continue
        count = control >> 5
        if count == 7:
            if at >= end:
                return -1
            count += int(packed[at])
            at += 1
        if at >= end:
            return -1
        source = place - ((control & 31) << 8) - int(packed[at]) - 1
        at += 1
        count += 2
        if source < 0 or place + count > room:
            return -1
        for _ in range(count):
            out[place] = out[source]
            place += 1
            source += 1
    return place
