"""Build a data set: every model from many sides, in several line styles, with exact truth."""

from __future__ import annotations

import multiprocessing
import os
import signal
import warnings
from collections import Counter
from collections.abc import Callable, Generator
from contextlib import closing
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from zlib import crc32

import numpy as np
from numpy.typing import NDArray

from lampblack.errors import LampblackError, LampblackWarning, OutputError

from . import creatures
from .deform import deformed
from .freestyle import Stroke, draw_freestyle
from .gbuffer import GBuffer, Placed, place, trace_placed
from .linework import LineStyle, draw_lines
from .models import find_models, load_model
from .smooth import smoothed
from .triple import Triple
from .viewpoints import PAPER_VIEWPOINTS, viewpoint

LARGE_SOURCE = 60
"""The models of a larger source are alike, so each of them is drawn from fewer sides."""

OCCLUSION_STEP = 0.012
"""Depth jump that counts as an occlusion, as a share of the character's size."""

CHUNK = 64
"""Largest number of views built together. One Blender process draws their Freestyle lines."""
_LEAST_SHARE = 0.02


@dataclass(frozen=True)
class DatasetOptions:
    """What to build.

    Attributes:
        views: number of views of each model.
        resolution: the box of a character has about the area of a square of this side, pixels.
        hands: number of drawings of each view, each in its own line style.
        deform: half of the views show the model with other proportions.
        freestyle: share of the views that have one drawing by Blender's Freestyle.
        creatures: number of random characters, each with one view.
        workers: number of processes; it does not change the data set.
    """

    views: int = PAPER_VIEWPOINTS
    resolution: int = 512
    hands: int = 3
    deform: bool = True
    freestyle: float = 0.2
    creatures: int = 0
    seed: int = 0
    workers: int = field(default=1, compare=False)


def entries(paths: list[Path], views: int) -> Generator[tuple[Path, int], None, None]:
    """(model, view) in the order of building: the first view of every model, then the second,
    so that an unfinished data set is balanced."""
    sizes = Counter(path.parent.name for path in paths)
    for index in range(views):
        for path in paths:
            if index < views * min(1.0, LARGE_SOURCE / sizes[path.parent.name]):
                yield path, index


def entry_path(output: Path, model: Path, index: int) -> Path:
    """The file of the ``index``-th view of ``model``."""
    return output / model.parent.name / f"{model.stem}.{index:02d}.npz"


def build_dataset(
    models: Path | None,
    output: Path,
    split: str | None,
    options: DatasetOptions,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> int:
    """Write the entries that are missing; return how many there are in all.

    The same models, options and seed give the same data set, with any number of workers and after
    any interruption. A view that shows nothing is left out. ``models`` may be None where creatures
    are asked for.

    Raises:
        LampblackError: nothing to draw. OutputError: ``output`` cannot be written.

    Warns:
        LampblackWarning: models cannot be used and are left out; one warning for each.
    """
    if models is None and not options.creatures:
        raise LampblackError("There is nothing to draw.", "Name a folder with --models.")
    paths = find_models(models, split) if models else []
    wanted = list(entries(paths, options.views))
    wanted += [(Path(creatures.SOURCE) / f"{n:04d}", 0) for n in range(options.creatures)]
    for folder in {entry_path(output, path, 0).parent for path, _ in wanted}:
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"{folder} cannot be made.", "Choose another.", str(error)) from error
    missing = [task for task in wanted if not entry_path(output, *task).exists()]
    there = done = len(wanted) - len(missing)
    progress(done, len(wanted))
    refused: set[str] = set()
    with closing(_built(missing, output, options)) as built:
        for tried, (made, reasons) in built:
            done, there = done + tried, there + made
            refused |= reasons
            progress(done, len(wanted))
    for reason in sorted(refused):
        warnings.warn(f"{reason} It is left out.", LampblackWarning, stacklevel=2)
    return there


_Task = tuple[Path, int]
_Built = tuple[int, set[str]]
"""How many entries were made, and why models were refused."""


def _built(
    tasks: list[_Task], output: Path, options: DatasetOptions
) -> Generator[tuple[int, _Built], None, None]:
    """Build in chunks; yield for each how many entries were tried, and what came of them."""
    size = max(1, min(CHUNK, len(tasks) // options.workers))
    chunks = [tasks[start : start + size] for start in range(0, len(tasks), size)]
    build = partial(_build, output=output, options=options)
    if options.workers == 1:
        yield from zip(map(len, chunks), map(build, chunks), strict=True)
        return
    with multiprocessing.get_context("spawn").Pool(options.workers, _run_in_background) as pool:
        yield from zip(map(len, chunks), pool.imap(build, chunks), strict=True)


def _run_in_background() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.nice(5)


def _build(tasks: list[_Task], output: Path, options: DatasetOptions) -> _Built:
    made, styled, refused = 0, [], set()
    for path, index in tasks:
        try:
            drawn = _draw(path, index, options)
        except LampblackError as error:
            refused.add(error.what)
            continue
        if drawn is None:
            continue
        made += 1
        where = entry_path(output, path, index)
        if drawn.freestyle is None:
            _save(drawn, where, options)
        else:
            styled.append((drawn, drawn.freestyle, where))
    if styled:
        inked = draw_freestyle([freestyle for _, freestyle, _ in styled])
        for (drawn, _, where), ink in zip(styled, inked, strict=True):
            if ink is not None:
                drawn.lines[0] = ink * drawn.view.mask
            _save(drawn, where, options)
    return made, refused


def _save(drawn: _Drawn, path: Path, options: DatasetOptions) -> None:
    Triple.of(drawn.view, drawn.lines, OCCLUSION_STEP * options.resolution).save(path)


@dataclass(frozen=True)
class _Drawn:
    view: GBuffer
    lines: list[NDArray[np.float32]]
    freestyle: tuple[Placed, Stroke] | None


def _draw(path: Path, index: int, options: DatasetOptions) -> _Drawn | None:
    """A view and its drawings, without Freestyle's; None if there is nothing to see.

    Raises:
        LampblackError: the model cannot be used.
    """
    name = f"{path.parent.name}/{path.stem}"
    rng = np.random.default_rng([options.seed, crc32(name.encode()), index])
    side = index
    if path.parent.name == creatures.SOURCE:
        model, side = creatures.creature(name, rng), int(rng.integers(PAPER_VIEWPOINTS))
    else:
        model = smoothed(load_model(path))
        if options.deform and rng.random() < 0.5:
            model = deformed(model, rng)
    placed = place(model, viewpoint(side, rng), options.resolution, equal_area=True)
    view = trace_placed(placed)
    if view.mask.sum() < _LEAST_SHARE * options.resolution**2:
        return None
    lines = [
        draw_lines(view, LineStyle.random(rng, options.resolution), rng)
        for _ in range(options.hands)
    ]
    styled = rng.random() < options.freestyle
    stroke = (placed, Stroke.random(rng, options.resolution)) if styled else None
    return _Drawn(view, lines, stroke)
