"""A bounded folder of arrays, keyed by the digest of their inputs."""

from __future__ import annotations

import contextlib
import hashlib
import os
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .atomic import atomic_file
from .errors import OutputError

MAX_BYTES = 2 << 30


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


def user_cache_folder() -> Path:
    """The user's cache folder (XDG base directories)."""
    base = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(base) / "lampblack"


class ArrayCache:
    """Keeps arrays across runs. The least recently used are deleted when the folder is too large.

    A cache that cannot be read or written only costs time, so that is no error.
    """

    def __init__(self, folder: Path, max_bytes: int = MAX_BYTES) -> None:
        self._folder = folder
        self._max_bytes = max_bytes

    def get(self, key: str, make: Callable[[], NDArray[np.float32]]) -> NDArray[np.float32]:
        """The array of ``key``. If it is missing, ``make`` computes it and it is stored."""
        path = self._folder / f"{key}.npz"
        try:
            with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
                array: NDArray[np.float32] = archive["array"].astype(np.float32)
            with contextlib.suppress(OSError):
                os.utime(path)
            return array
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
            array = make()
        with contextlib.suppress(OSError, OutputError):
            self._put(path, array)
        return array

    def _put(self, path: Path, array: NDArray[np.float32]) -> None:
        self._folder.mkdir(parents=True, exist_ok=True)
        with atomic_file(path) as file:
            np.savez(file, array=array)
        self._trim()

    def _trim(self) -> None:
        entries = sorted(
            (status.st_mtime, status.st_size, path)
            for path in self._folder.glob("*.npz")
            if (status := path.stat())
        )
        excess = sum(size for _, size, _ in entries) - self._max_bytes
        for _, size, path in entries:
            if excess <= 0:
                return
            path.unlink(missing_ok=True)
            excess -= size


def surface_cache() -> ArrayCache:
    """The cache of normals and heights that all programs of this user share."""
    return ArrayCache(user_cache_folder() / "surfaces")
