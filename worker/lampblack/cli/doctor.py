"""``lampblack doctor``: a check of the installation."""

from __future__ import annotations

import os
import platform
import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import typer

from .. import __version__
from ..errors import LampblackError
from ..processors import usable_processors
from .console import EXIT_FAILED, print_error


def doctor() -> None:
    """Check this installation part by part.

    Graphics cards are tried again, with a test picture on each. The last check renders a tiny
    picture.

    Example: lampblack doctor
    """
    checks: dict[str, Callable[[], str]] = {
        "lampblack": lambda: f"{__version__}, Python {platform.python_version()}",
        "machine": _machine,
        "temporary folder": _temporary_folder,
        "network": _network,
        "graphics cards": _cards,
        "Cycles": _cycles,
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
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return f"{platform.platform()}, {usable_processors()} cores, {memory:.0f} GiB"


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
    import numpy as np

    from ..api import light

    rows, columns = np.mgrid[-1:1:64j, -1:1:64j]
    picture = np.zeros((64, 64, 4), np.uint8)
    picture[np.hypot(rows, columns) < 0.8] = (230, 120, 40, 255)
    if not light(picture)[..., :3].any():
        raise LampblackError("Cycles rendered black.", "Reinstall bpy.")
    return "renders"
