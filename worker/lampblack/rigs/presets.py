"""The rigs that come with Lampblack, and rigs in files."""

from __future__ import annotations

import functools
from importlib import resources
from pathlib import Path

from ..errors import SceneError
from ..files import read_bounded
from ..scene import MAX_JSON_BYTES, Rig, decode_rig

PRESETS = ("key", "rim", "three-point", "sunset", "moon", "under-light", "lantern")
"""Names of the rigs that come with Lampblack, in the order in which they are shown."""


@functools.cache
def preset(name: str) -> Rig:
    """The rig ``name`` of ``PRESETS``."""
    return decode_rig((resources.files(__package__) / "presets" / f"{name}.json").read_bytes())


def preset_name(named: str) -> str | None:
    """The name in ``PRESETS`` that an artist may have written like this; None if there is none."""
    name = named.strip().lower().replace(" ", "-")
    return name if name in PRESETS else None


def find_rig(named: str) -> Rig:
    """The rig that comes with Lampblack under this name, or else the one in this file.

    Raises:
        SceneError: there is neither, or the file is no rig.
    """
    if (name := preset_name(named)) is not None:
        return preset(name)
    path = Path(named)
    try:
        return decode_rig(read_bounded(path, MAX_JSON_BYTES))
    except FileNotFoundError as error:
        raise SceneError(
            f"There is no rig {named[:200]!r}.",
            f"Name a file, or one of {', '.join(PRESETS)}.",
            str(error),
        ) from error
    except OSError as error:
        raise SceneError(
            f"The rig {named[:200]!r} cannot be read: {error.strerror}.", "Name another file."
        ) from error
