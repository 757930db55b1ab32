"""PNG and TIFF pictures in linear light with 16 bits, whose dark tones 8 bits would lose."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from PIL.ImageFile import ImageFile

from ..colour import srgb

_ORDERS = {"little": (";16L", ";16B"), "big": (";16B", ";16L")}
"""Pillow keeps one byte of each sample: the high one, if it is told the order of the file. Told the
other order, it keeps the low one."""


def fine_picture(image: ImageFile, again: Callable[[], ImageFile], gamma: float) -> Image.Image:
    """A picture in RGB or RGBA with 16 bits as RGBA in sRGB.

    Args:
        image: not yet decoded. again: opens the same file again.
        gamma: what the samples are of the light: its power. 1 is linear.
    """
    key = image.info.get("transparency")
    channels, order = _layout(image)
    high, low = (channels.replace("a", "A") + each for each in _ORDERS[order])
    samples = _bytes_of(image, high).astype(np.uint16) << 8 | _bytes_of(again(), low)
    levels = levels_of(gamma)
    colour = samples[..., :3]
    if samples.shape[2] == 4:
        opacity = samples[..., 3:].astype(np.uint32)
        alpha = ((opacity[..., 0] + 128) // 257).astype(np.uint8)
        if "a" in channels:  # colours times alpha
            straight = (colour.astype(np.uint32) * 65535 + opacity // 2) // np.maximum(opacity, 1)
            colour = np.minimum(straight, 65535).astype(np.uint16)
    else:
        opaque = np.ones(samples.shape[:2], bool) if key is None else (samples != key).any(axis=2)
        alpha = np.where(opaque, 255, 0).astype(np.uint8)
    return Image.fromarray(np.dstack([levels[colour], alpha]))


def levels_of(gamma: float) -> NDArray[np.uint8]:
    """(65536,) the sRGB level of each sample of 16 bits."""
    light = (np.arange(65536) / 65535) ** (1 / gamma)
    levels: NDArray[np.uint8] = np.rint(srgb(light) * 255).astype(np.uint8)
    return levels


def _layout(image: ImageFile) -> tuple[str, str]:
    """The channels of a file, as Pillow calls them, and the order of the bytes of a sample."""
    raw = _decoder_words(image.tile[0].args)[0]
    channels, _, samples = str(raw).partition(";")
    return channels, {"16L": "little", "16B": "big"}.get(samples, sys.byteorder)


def _bytes_of(image: ImageFile, mode: str) -> NDArray[np.uint8]:
    image.tile = [tile._replace(args=(mode, *_decoder_words(tile.args)[1:])) for tile in image.tile]
    image.load()
    return np.asarray(image)


def _decoder_words(args: tuple[Any, ...] | str | None) -> tuple[Any, ...]:
    """What Pillow's decoders are told: how samples lie in the file, and more."""
    return args if isinstance(args, tuple) else (args,)
