"""Files, folders and patterns to frames in order."""

from __future__ import annotations

import re
import warnings
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, TypeVar

from ..errors import DrawingError, LampblackWarning

MAX_FRAMES = 100_000

_NUMBER = re.compile(r"(\d+)(?=\.png$)", re.IGNORECASE)
_PATTERN = re.compile(r"%0?(\d*)d")
_RANGE = re.compile(r"(\d{1,9})(?:-(\d{1,9})(?:x(\d{1,9}))?)?")


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

    An input is a PNG file, a folder of them, or a printf pattern (``walk.%04d.png``). The
    frame number is the run of digits before ``.png`` (``walk.0001.png``, ``walk0001.png``).
    The frames of a folder or a pattern are sorted by number; gaps are allowed. Inputs keep
    their order. A file that is named twice counts once.

    Raises:
        DrawingError: nothing is named, a file is missing, or a folder has no PNG files.
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
    """Frame numbers of a list such as ``1-20x2,25``: ranges, each with an optional step.

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
        return _in_order(frames, f"The folder {path} holds no PNG files.")
    pattern = _PATTERN.search(path.name)
    if pattern is not None and not path.exists():
        before, after = path.name[: pattern.start()], path.name[pattern.end() :]
        width = int(pattern[1] or 1)
        name = re.compile(re.escape(before) + rf"(\d{{{width},9}})" + re.escape(after))
        if not path.parent.is_dir():
            raise DrawingError(f"There is no folder {path.parent}.", "Check its name.")
        matches = [
            Frame(int(match[1]), file)
            for file in _pictures_in(path.parent)
            if (match := name.fullmatch(file.name))
        ]
        return _in_order(matches, f"No frames match {path}.")
    if not path.exists():
        raise DrawingError(f"There is no drawing at {path}.", "Check the name and the folder.")
    return [Frame(_number(path), path)]


def _pictures_in(folder: Path) -> list[Path]:
    try:
        return [
            file
            for file in folder.iterdir()
            if file.suffix.lower() == ".png" and not file.name.startswith(".") and file.is_file()
        ]
    except OSError as error:
        raise DrawingError(
            f"The folder {folder} could not be read.", "Check its permissions.", str(error)
        ) from error


def _in_order(frames: Sequence[Frame], nothing: str) -> list[Frame]:
    if not frames:
        raise DrawingError(nothing, "Check the name, and that the drawings are PNG files.")
    return sorted(
        frames, key=lambda f: (f.number is None, f.number if f.number is not None else 0, f.path)
    )


def _number(path: Path) -> int | None:
    match = _NUMBER.search(path.name)
    return int(match[1]) if match and len(match[1]) <= 9 else None
