"""Files appear whole or not at all, whenever the writer is interrupted."""

from __future__ import annotations

from pathlib import Path
from typing import IO, Any

import pytest

from lampblack.atomic import atomic_file
from lampblack.errors import OutputError


def test_a_file_appears_when_it_is_whole(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    path.write_bytes(b"old")
    with atomic_file(path) as file:
        file.write(b"new")
        assert path.read_bytes() == b"old"
    assert path.read_bytes() == b"new"
    assert list(tmp_path.iterdir()) == [path]
    plain = tmp_path / "plain"
    plain.touch()
    assert path.stat().st_mode == plain.stat().st_mode


def test_an_interrupted_file_leaves_nothing(tmp_path: Path) -> None:
    def half(file: IO[bytes]) -> None:
        file.write(b"half")
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt), atomic_file(tmp_path / "a.png") as file:
        half(file)
    assert not list(tmp_path.iterdir())


def test_an_interruption_while_the_file_is_made_leaves_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plainly = Path.open

    def made_then_interrupted(path: Path, *how: Any, **more: Any) -> IO[Any]:
        plainly(path, *how, **more).close()
        assert list(tmp_path.iterdir())
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "open", made_then_interrupted)
    with pytest.raises(KeyboardInterrupt), atomic_file(tmp_path / "a.png"):
        pass
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="folder exists"), atomic_file(tmp_path / "no" / "a.png"):
        pass
