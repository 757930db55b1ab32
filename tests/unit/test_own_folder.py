"""Temporary folders: private, and not left behind for long by a process that was killed."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from lampblack.own_folder import NAME_BYTES, own_folder
from lampblack.service.endpoint import private_endpoint


def test_the_folders_of_ended_processes_are_removed(tmp_path: Path) -> None:
    ended = subprocess.run([sys.executable, "-c", "import os; print(os.getpid())"],
                           capture_output=True, text=True, check=True).stdout.strip()  # fmt: skip
    left = tmp_path / f"lampblack-{ended}-abcd1234"
    (left / "inside").mkdir(parents=True)
    of_pencil2d = tmp_path / f"lampblack-{ended}-qtXyZabC"
    of_pencil2d.mkdir()
    others = [tmp_path / f"lampblack-{os.getpid()}-abcd1234", tmp_path / "lampblack-1x-abcd1234"]
    others += [tmp_path / f"lampblack-{ended}", tmp_path / f"blender-{ended}-abcd1234"]
    for folder in others:
        folder.mkdir()
    link = tmp_path / f"lampblack-{ended}-link1234"
    link.symlink_to(others[0])
    (others[0] / "kept").touch()
    made = own_folder(tmp_path)
    assert made.stat().st_mode & 0o777 == 0o700
    assert len(made.name) <= NAME_BYTES
    assert not left.exists()
    assert not of_pencil2d.exists()
    assert all(folder.is_dir() for folder in others)
    assert (others[0] / "kept").exists(), "a link is not followed"


def test_a_worker_removes_what_another_pencil2d_left(tmp_path: Path) -> None:
    ended = subprocess.run([sys.executable, "-c", "import os; print(os.getpid())"],
                           capture_output=True, text=True, check=True).stdout.strip()  # fmt: skip
    left, ours = (tmp_path / f"lampblack-{pid}-qtXyZabC" for pid in (ended, os.getpid()))
    for folder in (left, ours):
        folder.mkdir()
    made = own_folder(ours)
    assert made.parent == ours.resolve()
    assert list(tmp_path.iterdir()) == [ours]


@pytest.fixture
def short_path() -> Iterator[Path]:
    """A folder whose path leaves room for that of a socket."""
    with TemporaryDirectory(prefix="l", dir="/tmp") as folder:
        yield Path(folder)


def test_a_killed_worker_leaves_no_socket_for_long(
    short_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(short_path))
    program = (
        "import os, signal; from lampblack.service.endpoint import private_endpoint\n"
        "with private_endpoint() as endpoint: os.kill(os.getpid(), signal.SIGKILL)"
    )
    subprocess.run([sys.executable, "-c", program], check=False)
    (left,) = short_path.iterdir()
    with private_endpoint() as endpoint:
        assert not left.exists()
        assert endpoint.startswith(f"ipc://{short_path}/lampblack-{os.getpid()}-")
    assert not list(short_path.iterdir())
