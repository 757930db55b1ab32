"""A bounded folder of arrays, keyed by the digest of their inputs."""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from safetensors import SafetensorError, safe_open
from safetensors.numpy import save

from . import __version__
from .atomic import atomic_file
from .errors import OutputError

MAX_BYTES = 2 << 30
_SUFFIX = ".safetensors"

Arrays = dict[str, NDArray[np.float32]]


def digest(*parts: object) -> str:
    """A digest of ``parts``: arrays, bytes, or anything with a stable repr."""
    state = hashlib.blake2b(digest_size=20)
    for part in parts:
        if isinstance(part, np.ndarray):
            state.update(f"{part.dtype}{part.shape}".encode())
            state.update(np.ascontiguousarray(part).data)
        else:
            state.update(part if isinstance(part, bytes) else repr(part).encode())
        state.update(b"\0")
    return state.hexdigest()


@cache
def program_digest() -> str:
    """A digest of this program: its version and its sources, which change more often. What another
    program made of the same drawing is not used."""
    sources = sorted(Path(__file__).parent.rglob("*.py"))
    return digest(__version__, *(source.read_bytes() for source in sources))


def user_cache_folder() -> Path:
    """The user's cache folder (XDG base directories)."""
    base = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(base) / "lampblack"


class ArrayCache:
    """Keeps arrays across runs. The least recently used are deleted when the folder is too large.

    A cache that cannot be read or written only costs time, so that is no error. An entry is
    believed only if it is, to the last byte, what was stored under its key, and if nobody else
    may write to the folder.
    """

    def __init__(self, folder: Path, max_bytes: int = MAX_BYTES) -> None:
        self._folder = folder
        self._max_bytes = max_bytes

    def get(self, key: str, make: Callable[[], Arrays]) -> Arrays:
        """The arrays of ``key``, float32, by name. If they are missing, ``make`` computes them and
        they are stored."""
        path = self._folder / f"{key}{_SUFFIX}"
        stored = self._read(path, key)
        if stored is not None:
            return stored
        arrays = make()
        with contextlib.suppress(OSError, OutputError):
            self._put(path, key, arrays)
        return arrays

    def _read(self, path: Path, key: str) -> Arrays | None:
        try:
            if not (_is_private(self._folder) and stat.S_ISREG(path.lstat().st_mode)):
                return None
            with safe_open(path, "numpy") as file:
                names: list[str] = file.keys()
                arrays: Arrays = {name: file.get_tensor(name) for name in names}
                whole = (file.metadata() or {}).get("digest") == _entry_digest(key, arrays)
            if not whole:
                return None
            os.utime(path)
        except (OSError, SafetensorError, ValueError, KeyError, TypeError):
            return None
        return arrays

    def _put(self, path: Path, key: str, arrays: Arrays) -> None:
        self._folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not _is_private(self._folder):
            return
        with atomic_file(path) as file:
            metadata = {"digest": _entry_digest(key, arrays)}
            file.write(save({n: np.ascontiguousarray(a) for n, a in arrays.items()}, metadata))
        self._trim()

    def _trim(self) -> None:
        entries = sorted(
            (status.st_mtime, status.st_size, path)
            for path in self._folder.iterdir()
            if stat.S_ISREG((status := path.lstat()).st_mode)
        )
        excess = sum(size for _, size, _ in entries) - self._max_bytes
        for _, size, path in entries:
            if excess <= 0:
                return
            path.unlink(missing_ok=True)
            excess -= size


def _entry_digest(key: str, arrays: Mapping[str, NDArray[np.float32]]) -> str:
    return digest(key, *(part for name in sorted(arrays) for part in (name, arrays[name])))


def _is_private(folder: Path) -> bool:
    """Whether only this user can have put files into it."""
    if os.name != "posix":
        return True
    found = folder.stat()
    return found.st_uid == os.geteuid() and not found.st_mode & (stat.S_IWGRP | stat.S_IWOTH)


def surface_cache() -> ArrayCache:
    """The cache of normals and heights that all programs of this user share."""
    return ArrayCache(user_cache_folder() / "surfaces")
