"""``lampblack doctor``: a check of the installation."""

from __future__ import annotations

import os
import platform
import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from .. import __version__
from ..errors import LampblackError
from ..processors import memory_bytes, usable_processors
from .console import EXIT_FAILED, print_error

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

LIVE_SECONDS = 600
"""A slow machine compiles for minutes."""


def doctor() -> None:
    """Check this installation part by part.

    Graphics cards are tried again, with a test picture on each. The last two checks light a tiny
    drawing, as a final frame and in a live preview. The first run takes a minute: it compiles loops
    over pixels, and keeps them.

    Example: lampblack doctor
    """
    checks: dict[str, Callable[[], str]] = {
        "lampblack": lambda: f"{__version__}, Python {platform.python_version()}",
        "machine": _machine,
        "temporary folder": _temporary_folder,
        "network": _network,
        "graphics cards": _cards,
        "Cycles": _cycles,
        "live preview": _live_preview,
    }
    failed = False
    for name, check in checks.items():
        try:
            sys.stdout.write(f"{name}: {check()}\n")
        except LampblackError as error:
            failed = True
            print_error(error, f"{name}: ")
        sys.stdout.flush()
    if failed:
        raise typer.Exit(EXIT_FAILED)


def _machine() -> str:
    told = [platform.platform(), f"{usable_processors()} cores"]
    if memory := memory_bytes():
        told.append(f"{memory / 2**30:.0f} GiB")
    return ", ".join(told)


def _temporary_folder() -> str:
    folder = tempfile.gettempdir()
    free = shutil.disk_usage(folder).free / 2**30
    if free < 0.5:
        raise LampblackError(
            f"{folder} has {free:.1f} GiB left.", "Make room, or set TMPDIR to another folder."
        )
    return f"{folder}, {free:.0f} GiB free"


def _network() -> str:
    import numpy as np

    from ..normals.card import shipped_weights
    from ..normals.predict import NormalPredictor

    predictor = NormalPredictor()
    mask = np.zeros((64, 64), bool)
    mask[16:48, 16:48] = True
    found = predictor.predict(np.zeros((64, 64), np.float32), mask, grids=1).normals
    if not np.isfinite(found).all():
        raise LampblackError("The network predicts numbers that are not finite.", "Reinstall.")
    size = Path(shipped_weights()).stat().st_size / 2**20
    return f"{predictor.card.architecture}, {size:.1f} MiB of weights"


def _cards() -> str:
    from ..render.survey import survey

    found = survey()
    if not found:
        return "none found; the processor traces"
    return "".join(
        f"\n  {one.card.label}: "
        + (
            ("right" if one.verdict.denoises else "right, but the processor denoises")
            if one.verdict.outcome == "right"
            else f"not used: {one.verdict.why}"
        )
        for one in found
    )


def _cycles() -> str:
    from ..api import light

    if not light(_two_balls())[..., :3].any():
        raise LampblackError("Cycles rendered black.", "Reinstall bpy.")
    return "renders"


def _live_preview() -> str:
    from ..scene import default_scene
    from ..service.client import Worker

    drawing = _two_balls()
    height, width = drawing.shape[:2]
    with (
        tempfile.TemporaryDirectory() as folder,
        Worker(Path(folder), os.getpid()) as worker,
        worker.connect() as client,
    ):
        try:
            client.hello()
            client.set_scene(default_scene(width, height))
            client.announce(1, drawing)
            client.look(1, (width, height), (0.0, 0.0, float(width), float(height)))
            client.picture(LIVE_SECONDS, lambda image: image.converged)
        except TimeoutError as error:
            raise LampblackError(
                "The live preview shows nothing.",
                "Close other programs, and try again.",
                str(error),
            ) from error
    return "lights"


def _two_balls() -> NDArray[np.uint8]:
    """(96, 96, 4): one in front of the other, with lines around them."""
    import numpy as np

    picture = np.zeros((96, 96, 4), np.uint8)
    rows, columns = np.indices(picture.shape[:2])
    for middle, colour in ((36, (230, 120, 40, 255)), (60, (40, 120, 230, 255))):
        distance = np.hypot(rows - middle, columns - middle)
        picture[distance < 30] = 20, 20, 20, 255
        picture[distance < 28] = colour
    return picture
