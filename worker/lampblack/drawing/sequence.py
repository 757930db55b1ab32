"""Files, folders and patterns to frames in order."""

from __future__ import annotations

import re
import warnings
from collections import Counter
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, TypeVar

from ..errors import DrawingError, LampblackWarning
from .load import PICTURE_SUFFIXES
from .numbering import is_pattern, number_in, numbered_names, series

MAX_FRAMES = 100_000

LAYERED_SUFFIXES = (".ora", ".psd", ".psb", ".kra")
"""Of files that hold the layers of one drawing."""
_PROJECTS = (".pclx", ".pcl")
_RANGE = re.compile(r"(-?\d{1,9})(?:-(-?\d{1,9})(?:x(\d{1,9}))?)?")


class HasNumber(Protocol):
    """Any kind of frame."""

    @property
    def number(self) -> int | None:
        """The frame's number; None where frames are not numbered."""


Numbered = TypeVar("Numbered", bound=HasNumber)


@dataclass(frozen=True)
class Frame:
    """One drawing of an animation; ``number`` is None for a name without digits."""

    number: int | None
    path: Path


def find_frames(inputs: Sequence[str | Path]) -> list[Frame]:
    """The frames that ``inputs`` name.

    An input is a picture file, a folder of them, or a pattern: ``walk.%04d.png``,
    ``walk.####.png`` or ``walk..png``, as OpenToonz has it. In a pattern, and in a folder without
    pictures, drawings with layers (``walk.%04d.psd``) are as good. The frame number is at the
    end of the name (``walk.0001.png``, ``walk0001.png``, ``walk.-0001.png``), or else at its start
    (``1-walk.png``). The frames of a folder or a pattern are sorted by number, those without one
    come last; gaps are allowed. Inputs keep their order. A file that is named twice counts once.

    Raises:
        DrawingError: nothing is named, a file is missing, or a folder has no pictures.

    Warns:
        LampblackWarning: a folder holds links to pictures that do not exist, or several sequences;
            or a pattern has other capitals than its files.
    """
    if not inputs:
        raise DrawingError("No drawing was named.", "Name a PNG file or a folder of them.")
    frames: dict[Path, Frame] = {}
    for item in inputs:
        for frame in _frames_of(Path(item)):
            frames.setdefault(frame.path, frame)
    if len(frames) > MAX_FRAMES:
        raise DrawingError(
            f"{len(frames)} frames were named; {MAX_FRAMES} is the most.", "Name fewer at a time."
        )
    return list(frames.values())


def parse_frames(text: str) -> list[int]:
    """Frame numbers of a list such as ``1-20x2,25``: ranges, each with an optional step. Numbers
    may be negative: ``-5--1``.

    Ascending, each number once.

    Raises:
        DrawingError: the text is no such list, a range runs backwards, or there are too many.
    """
    numbers: set[int] = set()
    for part in text.split(","):
        match = _RANGE.fullmatch(part.strip())
        if match is None:
            raise DrawingError(
                f"{text[:80]!r} is not a list of frames.", "Write it like 1-20x2,25."
            )
        first = int(match[1])
        last = int(match[2] or first)
        step = int(match[3] or 1)
        if last < first or step < 1:
            raise DrawingError(
                f"The frames {part.strip()!r} go backwards, or their step is 0.",
                "Write the lower number first and a step of at least 1.",
            )
        span = range(first, last + 1, step)
        if len(span) + len(numbers) > MAX_FRAMES:
            raise DrawingError(
                f"The list names more than {MAX_FRAMES} frames.", "Render it in parts."
            )
        numbers.update(span)
    return sorted(numbers)


def frame_list(numbers: Sequence[int]) -> str:
    """Ascending numbers as text for ``parse_frames``, consecutive ones as ranges: ``1-4,9``."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ",".join(f"{run[0]}-{run[-1]}" if len(run) > 1 else f"{run[0]}" for run in runs)


def select_frames(frames: Sequence[Numbered], numbers: Collection[int]) -> list[Numbered]:
    """The frames whose number is in ``numbers``, in their own order.

    Raises:
        DrawingError: none of the numbers exists.

    Warns:
        LampblackWarning: some of the numbers do not exist.
    """
    wanted = set(numbers)
    chosen = [frame for frame in frames if frame.number in wanted]
    if not chosen:
        there = [frame.number for frame in frames if frame.number is not None]
        span = f"from {min(there)} to {max(there)}" if there else "without numbers"
        raise DrawingError("None of the requested frames exists.", f"The frames are {span}.")
    missing = sorted(wanted - {frame.number for frame in chosen})
    if missing:
        named = ", ".join(map(str, missing[:8])) + (", ..." if len(missing) > 8 else "")
        warnings.warn(
            f"{len(missing)} of the requested frames do not exist: {named}.",
            LampblackWarning,
            stacklevel=2,
        )
    return chosen


def _frames_of(path: Path) -> list[Frame]:
    if path.is_dir():
        files = _files_in(path, PICTURE_SUFFIXES) or _files_in(path, LAYERED_SUFFIXES)
        frames = [Frame(number_in(file), file) for file in files]
        _tell_of_series(path, frames)
        if not frames and (projects := sorted(_files_in(path, _PROJECTS))):
            raise DrawingError(
                f"The folder {path} holds projects, but no pictures.",
                f"Name one of the projects: {projects[0]}.",
            )
        return _in_order(frames, f"The folder {path} holds no pictures.")
    if is_pattern(path.name) and not path.exists():
        return _matching(path)
    if not path.exists():
        raise DrawingError(f"There is no drawing at {path}.", "Check the name and the folder.")
    return [Frame(number_in(path), path)]


def _tell_of_series(folder: Path, frames: Sequence[Frame]) -> None:
    """Warn if a folder holds more than one drawing of a number, under several names."""
    numbers = Counter(frame.number for frame in frames if frame.number is not None)
    twice = {number for number, n in numbers.items() if n > 1}
    names = sorted({series(frame.path) for frame in frames if frame.number in twice})
    if len(names) > 1:
        warnings.warn(
            f"{folder} holds {len(names)} sequences ({', '.join(map(repr, names[:4]))}), which are "
            "lit as one. Name each by a pattern, such as walk.%04d.png, to light it on its own.",
            LampblackWarning,
            stacklevel=4,
        )


def _matching(path: Path) -> list[Frame]:
    """The frames of a pattern. Capitals count only if that tells two files apart.

    Warns:
        LampblackWarning: the files have other capitals than the pattern.
    """
    if not path.parent.is_dir():
        raise DrawingError(f"There is no folder {path.parent}.", "Check its name.")
    layered = path.suffix.lower() in LAYERED_SUFFIXES
    files = _files_in(path.parent, LAYERED_SUFFIXES if layered else PICTURE_SUFFIXES)
    for flags in (0, re.IGNORECASE):
        # The last place is meant: other digits, "#" and dots may be part of the name.
        name = re.compile(numbered_names(path.name)[-1].matching().pattern, flags)
        matches = [
            Frame(int(match[1]), file)
            for file in files
            if (match := name.fullmatch(file.name)) is not None
        ]
        if matches and flags:
            warnings.warn(
                f"No file is named exactly as {path.name}; {matches[0].path.name} and others with "
                "other capitals are used.",
                LampblackWarning,
                stacklevel=3,
            )
        if matches:
            break
    return _in_order(matches, f"No frames match {path}.")


def _files_in(folder: Path, suffixes: Collection[str]) -> list[Path]:
    try:
        named = [
            file
            for file in folder.iterdir()
            if file.suffix.lower() in suffixes and not file.name.startswith(".")
        ]
        lost = sorted(file.name for file in named if file.is_symlink() and not file.exists())
    except OSError as error:
        raise DrawingError(
            f"The folder {folder} could not be read.", "Check its permissions.", str(error)
        ) from error
    if lost:
        more = ", ..." if len(lost) > 8 else ""
        warnings.warn(
            f"{len(lost)} links in {folder} lead to no picture: {', '.join(lost[:8])}{more}.",
            LampblackWarning,
            stacklevel=2,
        )
    return [file for file in named if file.is_file()]


def _in_order(frames: Sequence[Frame], nothing: str) -> list[Frame]:
    if not frames:
        raise DrawingError(nothing, "Check the name, and that the drawings are picture files.")
    return sorted(
        frames, key=lambda f: (f.number is None, f.number or 0, _natural(f.path.name), f.path)
    )


def _natural(name: str) -> list[tuple[int, str]]:
    """A key by which ``a2b`` comes before ``a10b``."""
    parts = re.split(r"(\d{1,9})", name)
    return [(int(part), "") if part.isdigit() else (-1, part) for part in parts if part]
