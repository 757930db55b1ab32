"""The styles that come with Lampblack, and styles in files."""

from __future__ import annotations

import functools
from importlib import resources
from pathlib import Path

from ..errors import SceneError
from ..files import read_bounded
from ..scene import MAX_JSON_BYTES, Style, decode_style

PRESETS = ("smooth", "soft-cel", "hard-cel", "two-tone-rim")
"""Names of the styles that come with Lampblack, in the order in which they are shown."""


@functools.cache
def preset(name: str) -> Style:
    """The style ``name`` of ``PRESETS``."""
    return decode_style((resources.files(__package__) / "presets" / f"{name}.json").read_bytes())


def preset_name(named: str) -> str | None:
    """The name in ``PRESETS`` that an artist may have written like this; None if there is none."""
    name = "-".join(named.replace("+", " ").replace("-", " ").lower().split())
    return name if name in PRESETS else None


def find_style(named: str) -> Style:
    """The style that comes with Lampblack under this name, or else the one in this file.

    Raises:
        SceneError: there is neither, or the file is no style.
    """
    if (name := preset_name(named)) is not None:
        return preset(name)
    try:
        return decode_style(read_bounded(Path(named), MAX_JSON_BYTES))
    except FileNotFoundError as error:
        raise SceneError(
            f"There is no look {named[:200]!r}.",
            f"Name a file, or one of {', '.join(PRESETS)}.",
            str(error),
        ) from error
    except OSError as error:
        raise SceneError(
            f"The look {named[:200]!r} cannot be read: {error.strerror}.", "Name another file."
        ) from error
