"""The cache: hits, losses and limits."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import lampblack
from lampblack.cache import ArrayCache, Arrays, digest, program_digest

IGNORED = shutil.ignore_patterns("__pycache__")
PRINT_DIGEST = "from lampblack.cache import program_digest; print(program_digest())"
ONES = {"height": np.ones((2, 3), np.float32), "overlaps": np.zeros((0, 6), np.float32)}


def fresh() -> Arrays:
    return {"height": np.zeros((2, 3), np.float32), "overlaps": np.zeros((1, 6), np.float32)}


def entry(folder: Path) -> Path:
    (path,) = folder.iterdir()
    return path


def is_stored(folder: Path) -> bool:
    """Whether the entry is believed, as against made anew."""
    return bool(ArrayCache(folder).get("k", fresh)["height"].any())


def test_made_once_then_read(tmp_path: Path) -> None:
    made = []

    def make() -> Arrays:
        made.append(1)
        return ONES

    for _ in range(2):
        arrays = ArrayCache(tmp_path).get("k", make)
        assert arrays.keys() == ONES.keys()
        for name, array in arrays.items():
            assert array.dtype == np.float32
            assert np.array_equal(array, ONES[name])
    assert made == [1]


@pytest.mark.parametrize(
    "damage",
    [
        lambda whole: b"",
        lambda whole: b"PK\x03\x04",
        lambda whole: b"\x80\x04pickle",
        lambda whole: b"\xff" * 64,
        lambda whole: whole[:-1],
        lambda whole: whole + b"\0",
        lambda whole: whole[:-1] + b"\x7f",
        lambda whole: whole[:-4] + np.float32("nan").tobytes(),
        lambda whole: whole.replace(b"[2,3]", b"[3,2]"),
        lambda whole: whole.replace(b"[2,3]", b"[2,9]"),
        lambda whole: whole.replace(b"F32", b"I32"),
        lambda whole: whole.replace(b"height", b"weight"),
    ],
)
def test_a_damaged_entry_is_made_anew_once(
    tmp_path: Path, damage: Callable[[bytes], bytes]
) -> None:
    ArrayCache(tmp_path).get("k", lambda: ONES)
    whole = entry(tmp_path).read_bytes()
    assert damage(whole) != whole
    entry(tmp_path).write_bytes(damage(whole))
    assert not is_stored(tmp_path)
    healed = ArrayCache(tmp_path).get("k", lambda: ONES)
    assert not healed["height"].any(), "what was made anew is kept"


def test_an_entry_of_another_key_is_not_believed(tmp_path: Path) -> None:
    ArrayCache(tmp_path).get("other", lambda: ONES)
    entry(tmp_path).rename(tmp_path / entry(tmp_path).name.replace("other", "k"))
    assert not is_stored(tmp_path)


def test_an_entry_that_is_no_file_is_not_opened(tmp_path: Path) -> None:
    ArrayCache(tmp_path).get("k", lambda: ONES)
    path = entry(tmp_path)
    path.unlink()
    os.mkfifo(path)  # opening it would wait for ever
    assert not is_stored(tmp_path)


def test_a_folder_that_others_may_write_to_is_not_used(tmp_path: Path) -> None:
    ArrayCache(tmp_path).get("k", lambda: ONES)
    assert is_stored(tmp_path)
    tmp_path.chmod(0o777)
    assert not is_stored(tmp_path)
    tmp_path.chmod(0o700)
    assert is_stored(tmp_path), "nothing was stored in it meanwhile"


def test_least_lately_used_goes_first(tmp_path: Path) -> None:
    block = {"height": np.zeros(1000, np.float32)}
    (tmp_path / "left-by-an-older-version.npz").write_bytes(bytes(4000))
    os.utime(tmp_path / "left-by-an-older-version.npz", (0, 0))
    cache = ArrayCache(tmp_path, max_bytes=3 * 4500)
    for age, key in enumerate("abc"):
        cache.get(key, lambda: block)
        os.utime(tmp_path / f"{key}.safetensors", (1000 + age, 1000 + age))
    cache.get("a", lambda: block)  # used again
    cache.get("d", lambda: block)
    assert {path.stem for path in tmp_path.iterdir()} == {"a", "c", "d"}


def test_a_cache_that_cannot_be_written_only_costs_time(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    cache = ArrayCache(tmp_path / "file" / "cache")
    assert cache.get("k", lambda: ONES)["height"].sum() == 6


def test_digest_tells_shapes_types_and_order_apart() -> None:
    a = np.zeros((2, 3), np.float32)
    names = [digest(a), digest(a.T), digest(a.astype(np.int32)), digest(a, 1), digest(1, a)]
    assert len(set(names)) == len(names)
    assert digest(a.T) == digest(np.zeros((3, 2), np.float32))


def test_what_another_program_made_is_not_used(tmp_path: Path) -> None:
    """The same version with other sources is another program."""
    package = tmp_path / "lampblack"
    shutil.copytree(Path(lampblack.__file__).parent, package, ignore=IGNORED)

    def told() -> str:
        command = [sys.executable, "-c", PRINT_DIGEST]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
        return done.stdout

    same = told()
    assert same == told() == program_digest() + "\n"
    with (package / "surface" / "occlusions.py").open("a") as source:
        source.write("\n")
    assert told() != same
