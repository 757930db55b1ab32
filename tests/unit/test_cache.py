"""The cache: hits, losses and limits."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np

from lampblack.cache import ArrayCache, digest


def test_made_once_then_read(tmp_path: Path) -> None:
    array = np.random.default_rng(0).random((5, 4)).astype(np.float32)
    made = []

    def make() -> np.ndarray:  # type: ignore[type-arg]
        made.append(1)
        return array

    for _ in range(2):
        assert np.array_equal(ArrayCache(tmp_path).get("k", make), array)
    assert made == [1]


def test_damaged_entries_are_made_again(tmp_path: Path) -> None:
    cache = ArrayCache(tmp_path)
    for damage in (b"", b"PK\x03\x04", b"\x80\x04pickle"):
        (tmp_path / "k.npz").write_bytes(damage)
        assert cache.get("k", lambda: np.ones(3, np.float32)).sum() == 3
    assert cache.get("k", lambda: np.zeros(3, np.float32)).sum() == 3


def test_least_lately_used_goes_first(tmp_path: Path) -> None:
    block = np.zeros(1000, np.float32)
    cache = ArrayCache(tmp_path, max_bytes=3 * 4500)
    for age, key in enumerate("abc"):
        cache.get(key, lambda: block)
        os.utime(tmp_path / f"{key}.npz", (1000 + age, 1000 + age))
    cache.get("a", lambda: block)  # used again
    cache.get("d", lambda: block)
    assert {path.stem for path in tmp_path.glob("*.npz")} == {"a", "c", "d"}


def test_a_cache_that_cannot_be_written_only_costs_time(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    cache = ArrayCache(tmp_path / "file" / "cache")
    assert cache.get("k", lambda: np.ones(2, np.float32)).sum() == 2


def test_digest_tells_shapes_types_and_order_apart() -> None:
    a = np.zeros((2, 3), np.float32)
    names = [digest(a), digest(a.T), digest(a.astype(np.int32)), digest(a, 1), digest(1, a)]
    assert len(set(names)) == len(names)
    assert digest(a.T) == digest(np.zeros((3, 2), np.float32))
