"""Readers are fed with spoiled files: what they cannot read, they refuse as an error for people."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from lampblack.drawing import decompose_cel, load_picture
from lampblack.errors import LampblackError, LampblackWarning
from lampblack.finals.exr import exr_stamp
from lampblack.finals.ora import ora_stamp
from lampblack.finals.png import png_stamp
from lampblack.finals.resolve import resolve_shot
from lampblack.finals.scene_overrides import read_depth_hints, read_scene
from lampblack.finals.settings import RenderSettings
from lampblack.looks import find_style
from lampblack.project import is_project
from lampblack.rigs import find_rig
from support.memory import little_memory
from support.spoiled import samples, spoiled_files

LAYERED = Path(__file__).parents[1] / "data" / "layers"
MOST_MEMORY = 300 << 20


def shown(path: Path) -> None:
    """All that a render of the first frames reads."""
    opened = resolve_shot(RenderSettings(inputs=(str(path),), output="out"))
    for frame in opened.frames[:3]:
        cel = opened.shot.cel(frame)
        decompose_cel(cel)
        opened.shot.finish(frame, cel.pixels)


def readers_of(path: Path) -> list[Callable[[Path], object]]:
    if path.suffix == ".json":
        return [
            read_scene,
            read_depth_hints,
            lambda p: find_rig(str(p)),
            lambda p: find_style(str(p)),
        ]
    if path.suffix == ".exr":
        return [exr_stamp]
    return [shown, ora_stamp] if is_project(path) else [load_picture, png_stamp]


def feed(folder: Path, seed: int, count: int) -> int:
    """Feed the readers with spoiled files. Returns how many were refused."""
    kinds = samples(folder, LAYERED)
    for name, (data, _) in kinds.items():  # each sample is sound, or spoiling it would say nothing
        path = folder / name
        path.write_bytes(data)
        readers = readers_of(path)
        readers = readers[:1] if path.suffix != ".json" else readers
        understood = 0
        for reader in readers:
            with suppress(LampblackError):
                reader(path)
                understood += 1
        assert understood, name
    before = {path.name for path in folder.iterdir()}
    refused = 0
    for index, (name, data) in enumerate(spoiled_files(kinds, seed, count)):
        path = folder / name
        path.write_bytes(data)
        for reader in readers_of(path):
            try:
                with little_memory(MOST_MEMORY):
                    reader(path)
            except LampblackError:
                refused += 1
            except BaseException:
                (folder / f"guilty.{index}.{name}").write_bytes(data)
                raise
    assert {path.name for path in folder.iterdir()} == before
    return refused


@pytest.fixture(autouse=True)
def quiet(monkeypatch: pytest.MonkeyPatch) -> None:
    # Running Pencil2D for every spoiled vector drawing would take all day.
    monkeypatch.setattr("shutil.which", lambda name: None)


def test_a_thousand_spoiled_files(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", LampblackWarning)
        refused = feed(tmp_path, seed=2026, count=1000)
    assert refused > 400


@pytest.mark.slow
@pytest.mark.timeout(7200)
def test_a_hundred_thousand_spoiled_files(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", LampblackWarning)
        feed(tmp_path, seed=7, count=100_000)
