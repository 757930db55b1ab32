"""Temporary folders that do not outlive their process for long: what a killed one left behind is
removed by the next."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from contextlib import suppress
from pathlib import Path

NAME_BYTES = len("lampblack-4194304-") + 8
"""Longest name of a folder."""
_NAME = re.compile(r"lampblack-(\d{1,7})-\w{8}")


def own_folder(place: Path | None = None) -> Path:
    """A new folder that only this user can enter, named after this process. ``place`` is the
    system's temporary folder unless given. The caller removes it.

    Raises:
        OSError: it cannot be made.
    """
    place = place or Path(tempfile.gettempdir())
    _sweep(place)
    if _NAME.fullmatch(place.name):  # the one in which the plugin keeps all that is of its worker
        _sweep(place.parent)
    return Path(tempfile.mkdtemp(prefix=f"lampblack-{os.getpid()}-", dir=place)).resolve()


def _sweep(place: Path) -> None:
    """Remove this user's folders of processes that have ended."""
    with suppress(OSError):
        for folder in place.iterdir():
            owner = _NAME.fullmatch(folder.name)
            if owner is None or Path(f"/proc/{owner[1]}").exists() or not Path("/proc").exists():
                continue
            with suppress(OSError):
                if folder.lstat().st_uid == os.geteuid():
                    shutil.rmtree(folder, ignore_errors=True)
