"""PNG pictures in linear light with 16 bits, whose dark tones 8 bits would lose."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from PIL.PngImagePlugin import PngImageFile

from ..colour import srgb

_HIGH, _LOW = ";16B", ";16L"
"""Pillow keeps one byte of each sample: the high one of big-endian samples, which those of a PNG
are. Read as little-endian ones, they give their low byte."""


def fine_picture(
    image: PngImageFile, again: Callable[[], PngImageFile], gamma: float
) -> Image.Image:
    """A PNG in RGB or RGBA with 16 bits as RGBA in sRGB.

    Args:
        image: not yet decoded. again: opens the same file again.
        gamma: what the samples are of the light: its power. 1 is linear.
    """
    key = image.info.get("transparency")
    samples = _bytes_of(image, _HIGH).astype(np.uint16) << 8 | _bytes_of(again(), _LOW)
    levels = levels_of(gamma)
    if samples.shape[2] == 4:
        alpha = ((samples[..., 3].astype(np.uint32) + 128) // 257).astype(np.uint8)
    else:
        opaque = np.ones(samples.shape[:2], bool) if key is None else (samples != key).any(axis=2)
        alpha = np.where(opaque, 255, 0).astype(np.uint8)
    return Image.fromarray(np.dstack([levels[samples[..., :3]], alpha]))


def levels_of(gamma: float) -> NDArray[np.uint8]:
    """(65536,) the sRGB level of each sample of 16 bits."""
    light = (np.arange(65536) / 65535) ** (1 / gamma)
    levels: NDArray[np.uint8] = np.rint(srgb(light) * 255).astype(np.uint8)
    return levels


def _bytes_of(image: PngImageFile, order: str) -> NDArray[np.uint8]:
    image.tile = [tile._replace(args=image.mode + order) for tile in image.tile]
    image.load()
    return np.asarray(image)
