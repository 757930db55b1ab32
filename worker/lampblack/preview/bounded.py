"""A cache with bounded memory: the least recently used values are dropped first."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Hashable, Set
from typing import Generic, TypeVar

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")

MIB = 1 << 20


class BoundedStore(Generic[Key, Value]):
    """Keeps values of up to ``max_bytes`` in total; any thread may use it.

    The newest value is kept even if it alone is larger.
    """

    def __init__(self, max_bytes: int) -> None:
        self.max_bytes = max_bytes
        self._held: OrderedDict[Key, tuple[Value, int]] = OrderedDict()
        self._bytes = 0
        self._lock = threading.Lock()

    def put(self, key: Key, value: Value, nbytes: int) -> None:
        """Set the value of ``key``."""
        with self._lock:
            self._drop(key)
            self._held[key] = value, nbytes
            self._bytes += nbytes
            while self._bytes > self.max_bytes and len(self._held) > 1:
                self._drop(next(iter(self._held)))

    def get(self, key: Key) -> Value | None:
        """The value of ``key``, which becomes the most recently used; None if it is not kept."""
        with self._lock:
            if key not in self._held:
                return None
            self._held.move_to_end(key)
            return self._held[key][0]

    def drop(self, key: Key) -> None:
        """Drop ``key``, if it is kept."""
        with self._lock:
            self._drop(key)

    def keep(self, keys: Set[object]) -> None:
        """Drop all but ``keys``."""
        with self._lock:
            for key in [key for key in self._held if key not in keys]:
                self._drop(key)

    def keys(self) -> list[Key]:
        """All keys, the least recently used first."""
        with self._lock:
            return list(self._held)

    def __contains__(self, key: object) -> bool:
        return key in self._held

    def __len__(self) -> int:
        return len(self._held)

    @property
    def nbytes(self) -> int:
        """Total bytes of all values."""
        return self._bytes

    def _drop(self, key: Key) -> None:
        if key in self._held:
            self._bytes -= self._held.pop(key)[1]
