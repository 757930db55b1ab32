"""Files, folders and patterns to frames in order."""

from __future__ import annotations

import re
import warnings
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, TypeVar

from ..errors import DrawingError, LampblackWarning
from .load import PICTURE_SUFFIXES

MAX_FRAMES = 100_000

_AT_END = re.compile(r"(?:(?<![^._ ])-)?(?<!\d)\d{1,9}$")
"""After a letter or a digit, "-" is no sign."""
_AT_START = re.compile(r"-?\d{1,9}(?=[-._ ])")
_PATTERN = re.compile(r"%0?(\d*)d|#+|(?<=\.)(?=\.)")
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
    ``walk.####.png`` or ``walk..png``. The frame number is at the end of the name
    (``walk.0001.png``, ``walk0001.png``, ``walk.-0001.png``), or else at its start
    (``1-walk.png``). The frames of a folder or a pattern are sorted by number, those without one
    come last; gaps are allowed. Inputs keep their order. A file that is named twice counts once.

    Raises:
        DrawingError: nothing is named, a file is missing, or a folder has no pictures.

    Warns:
        LampblackWarning: a folder holds links to pictures that do not exist.
    """
    if not inputs:
        raise DrawingError("No drawing was named.", "Name a PNG file or a folder of them.")
    frames: dict[Path, Frame] = {}
    for item in inputs:
        for frame in _frames_of(Path(item)):
            frames.setdefault(frame.path, frame)
    if len(frames) > MAX_FRAMES:
        raise DrawingError(f"{len(frames)} frames were named; {MAX_FRAMES} is the most.")
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
                f"The frames {part.strip()!r} run backwards or have no step.",
                "Write the lower number first and a step of at least 1.",
            )
        span = range(first, last + 1, step)
        if len(span) + len(numbers) > MAX_FRAMES:
            raise DrawingError(f"The list names more than {MAX_FRAMES} frames.")
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
        frames = [Frame(_number(file), file) for file in _pictures_in(path)]
        return _in_order(frames, f"The folder {path} holds no pictures.")
    pattern = _PATTERN.search(path.name)
    if pattern is not None and not path.exists():
        if not path.parent.is_dir():
            raise DrawingError(f"There is no folder {path.parent}.", "Check its name.")
        before, after = path.name[: pattern.start()], path.name[pattern.end() :]
        number = _padded(pattern)
        name = re.compile(re.escape(before) + f"({number})" + re.escape(after))
        matches = [
            Frame(int(match[1]), file)
            for file in _pictures_in(path.parent)
            if (match := name.fullmatch(file.name))
        ]
        return _in_order(matches, f"No frames match {path}.")
    if not path.exists():
        raise DrawingError(f"There is no drawing at {path}.", "Check the name and the folder.")
    return [Frame(_number(path), path)]


def _padded(pattern: re.Match[str]) -> str:
    """What a number looks like there. A sign may count as one of the digits, or not."""
    width = len(pattern[0]) if pattern[0].startswith("#") else int(pattern[1] or 1)
    return rf"\d{{{width},9}}|-\d{{{max(1, width - 1)},9}}"


def _pictures_in(folder: Path) -> list[Path]:
    try:
        named = [
            file
            for file in folder.iterdir()
            if file.suffix.lower() in PICTURE_SUFFIXES and not file.name.startswith(".")
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


def _number(path: Path) -> int | None:
    match = _AT_END.search(path.stem) or _AT_START.match(path.stem)
    return int(match[0]) if match else None
