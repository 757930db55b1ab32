"""A turntable as an animated GIF."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..atomic import atomic_file

LOOP_SECONDS = 2.6


def save_gif(path: Path, loop: Sequence[NDArray[np.uint8]]) -> None:
    """Write (h, w, 3) uint8 sRGB pictures as a loop. They share one palette, made from the
    first, middle and last angle, so that colours do not change between pictures.

    Raises:
        OutputError: it cannot be written.
    """
    shown = [loop[index * len(loop) // 4] for index in (0, 1, 3)]
    palette = Image.fromarray(np.concatenate(shown)).quantize(256, Image.Quantize.MEDIANCUT)
    frames = [
        Image.fromarray(picture).quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)
        for picture in loop
    ]
    with atomic_file(path) as file:
        frames[0].save(
            file,
            "GIF",
            save_all=True,
            append_images=frames[1:],
            duration=round(1000 * LOOP_SECONDS / len(loop)),
            loop=0,
        )
