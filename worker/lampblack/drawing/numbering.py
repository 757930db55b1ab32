"""Frame numbers in the names of files."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

USUAL = 4
"""Digits of numbers whose pattern does not say."""
_FILES = "png|jpe?g|webp|tiff?|tga|bmp|gif|exr|npy|glb|obj|ply|ora|ps[db]|kra"
_PLACE = re.compile(r"%0?\d*d|#+")
_DOTTED = re.compile(rf"(?<=[^.]\.)(?=\.(?:{_FILES})$)", re.IGNORECASE)
"""Between two dots before the suffix of a file, as OpenToonz has it."""
_AT_END = re.compile(r"(?:(?<![^._ ])-)?(?<!\d)\d{1,9}$")
"""After a letter or a digit, "-" is no sign."""
_AT_START = re.compile(r"-?\d{1,9}(?=[-._ ])")


@dataclass(frozen=True)
class NumberedName:
    """A file name with a place for the frame number.

    Attributes:
        before, after: what is around the number.
        width: least number of digits; 0 where the pattern leaves it open.
    """

    before: str
    after: str
    width: int

    def name(self, number: int) -> str:
        """The name of a frame. A sign counts as one of its digits, as in ``%04d``."""
        return f"{self.before}{number:0{self.width or USUAL}d}{self.after}"

    def matching(self) -> re.Pattern[str]:
        """Matches names of frames; its group is the number. A sign may count as one of the digits,
        or not."""
        width = max(1, self.width)
        number = rf"\d{{{width},9}}|-\d{{{max(1, width - 1)},9}}"
        return re.compile(f"{re.escape(self.before)}({number}){re.escape(self.after)}")


def numbered_names(name: str) -> list[NumberedName]:
    """The places for a frame number in a name: ``walk.%04d.png``, ``walk.####.png``,
    ``walk..png``."""
    places = list(_PLACE.finditer(name)) or list(_DOTTED.finditer(name))
    return [
        NumberedName(name[: place.start()], name[place.end() :], _width(place[0]))
        for place in places
    ]


def is_pattern(name: str) -> bool:
    """Whether a name has a place for a frame number."""
    return bool(numbered_names(name))


def number_in(path: Path) -> int | None:
    """The frame number at the end of a file's name, or else at its start; None without one."""
    match = _AT_END.search(path.stem) or _AT_START.match(path.stem)
    return int(match[0]) if match else None


def series(path: Path) -> str:
    """What is left of a file's name without its number, in lower case."""
    match = _AT_END.search(path.stem) or _AT_START.match(path.stem)
    if match is None:
        return path.stem.lower()
    return (path.stem[: match.start()] + path.stem[match.end() :]).strip("._- ").lower()


def _width(place: str) -> int:
    if place.startswith("#"):
        return len(place)
    return min(int(place[1:-1] or 1), 9) if place else 0
