"""Moving pictures of a rendered shot, to look at: WebM and MP4 by ffmpeg, GIF and WebP without."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from ..atomic import atomic_file, atomic_path
from ..errors import LampblackError, OutputError

SUFFIXES = (".webm", ".mp4", ".gif", ".webp")
USUAL_FPS = 12
GROUND = 255, 255, 255
"""What shows through a transparent frame."""
MAX_SIDE = 1920
"""Larger frames are made smaller."""
_ENCODERS = {
    ".webm": ["-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-row-mt", "1"],
    ".mp4": ["-c:v", "libx264", "-crf", "16", "-movflags", "+faststart"],
}

Picture = NDArray[np.uint8]


def check_program(path: Path) -> None:
    """Refuse a video where ffmpeg is missing.

    Raises:
        LampblackError: see above.
    """
    if path.suffix.lower() in _ENCODERS and shutil.which("ffmpeg") is None:
        raise LampblackError(
            f"Only ffmpeg can write {path.name}, and it is not installed.",
            "Install it (on Debian: apt-get install ffmpeg), or name a .gif or .webp.",
        )


def save_moving_picture(path: Path, pictures: Iterable[Picture], fps: float) -> None:
    """Write ``pictures``, (H, W, 4) uint8 with straight alpha, one after another, in a loop where
    the file format has one. All are shown at the size of the first.

    Raises:
        LampblackError: there is no picture. OutputError: the file cannot be written.
    """
    frames = _prepared(pictures)
    first = next(frames, None)
    if first is None:
        raise LampblackError("There is no frame to show.", "Leave out --preview.")
    if path.suffix.lower() in _ENCODERS:
        _encode(path, first, frames, fps)
        return
    images = [first, *frames]
    if path.suffix.lower() == ".gif":
        images = _with_one_palette(images)
    kind = {"loop": 0, "save_all": True, "append_images": images[1:]}
    kind |= {"lossless": True} if path.suffix.lower() == ".webp" else {"optimize": False}
    with atomic_file(path) as file:
        images[0].save(file, path.suffix[1:].upper(), duration=round(1000 / fps), **kind)


def _prepared(pictures: Iterable[Picture]) -> Iterator[Image.Image]:
    size: tuple[int, int] | None = None
    for picture in pictures:
        image = Image.fromarray(picture)
        if size is None:
            scale = min(1.0, MAX_SIDE / max(image.size))
            size = max(1, round(image.width * scale)), max(1, round(image.height * scale))
        if image.size != size:
            image = image.convert("RGBa").resize(size, Image.Resampling.BOX).convert("RGBA")
        ground = Image.new("RGBA", size, (*GROUND, 255))
        ground.alpha_composite(image)
        yield ground.convert("RGB")


def _with_one_palette(images: Sequence[Image.Image]) -> list[Image.Image]:
    """So that colours do not change from frame to frame."""
    shown = [np.asarray(images[index * (len(images) - 1) // 3]) for index in range(4)]
    palette = Image.fromarray(np.concatenate(shown)).quantize(256, Image.Quantize.MEDIANCUT)
    dither = Image.Dither.FLOYDSTEINBERG
    return [image.quantize(palette=palette, dither=dither) for image in images]


def _encode(path: Path, first: Image.Image, rest: Iterable[Image.Image], fps: float) -> None:
    width, height = first.size
    with atomic_path(path) as temporary:
        command = [
            "ffmpeg", "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24",
            "-s", f"{width}x{height}", "-r", f"{fps:g}", "-i", "-", "-an",
            # Players want an even size, and colours with half of it.
            "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p",
            *_ENCODERS[path.suffix.lower()], "file:" + str(temporary.absolute()),
        ]  # fmt: skip
        with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as ffmpeg:
            assert ffmpeg.stdin is not None
            assert ffmpeg.stderr is not None
            try:
                for image in (first, *rest):
                    ffmpeg.stdin.write(image.tobytes())
                ffmpeg.stdin.close()
            except BrokenPipeError:
                pass  # what went wrong is in its own words
            words = ffmpeg.stderr.read().decode(errors="replace")
        if ffmpeg.returncode:
            raise OutputError(
                f"ffmpeg could not write {path.name}.", "Name a .gif or .webp.", words[-400:]
            )
