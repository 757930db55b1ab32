"""What several tests share: a small drawing, and caches that touch nobody's home."""

from __future__ import annotations

import os
import signal
import sys
import warnings
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import torch
from numpy.typing import NDArray

from lampblack.cache import ArrayCache
from lampblack.cli import main
from lampblack.drawing import Drawing, save_picture
from lampblack.pipeline import Pipeline
from lampblack.render.passes import LightPasses, Passes
from lampblack.surface import Overlap
from lampblack.surface_maker import SurfaceMaker
from support.command_line import Outcome, Run
from support.drawings import draw_ball
from support.window import missing, patience

TESTS = Path(__file__).parent
SHARED = ("display", "worker", "child", "pipeline")
"""Fixtures of the session. Tests that use one go to one process, so that it is made once."""


def pytest_configure(config: pytest.Config) -> None:
    """Share the cores out to ``pytest -n``: two that each take all of them wait for each other."""
    processes = config.getoption("numprocesses", None)
    if processes:
        cores = len(os.sched_getaffinity(0))
        os.environ.setdefault("OMP_NUM_THREADS", str(max(1, cores // processes)))


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark each test by the folder that it is in: what a test costs is said by where it is."""
    lacking = missing()
    for item in items:
        folder = item.path.relative_to(TESTS).parts[0]
        if folder in ("render", "window"):
            item.add_marker(folder)
            item.add_marker("cycles")
        if folder == "window":
            item.add_marker(pytest.mark.timeout(600 * patience()))
            item.add_marker(pytest.mark.skipif(bool(lacking), reason=f"missing: {lacking}"))
        shared = [name for name in SHARED if name in getattr(item, "fixturenames", ())]
        if shared:
            item.add_marker(pytest.mark.xdist_group(shared[0]))
    # Long groups first: the last one would keep one process busy while the other has nothing to do.
    items.sort(key=_group_rank)


def _group_rank(item: pytest.Item) -> int:
    group = item.get_closest_marker("xdist_group")
    return SHARED.index(group.args[0]) if group else len(SHARED)


@pytest.fixture(scope="session", autouse=True)
def user_cache(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """A cache for all tests, that is nobody's: normals of the same drawing are predicted once."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(autouse=True)
def torch_threads() -> Iterator[None]:
    """A trainer sets torch's threads, and the last bits of what is predicted depend on them."""
    before = torch.get_num_threads()
    yield
    torch.set_num_threads(before)


@pytest.fixture
def own_cache(user_cache: None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache, for a test that cannot share one."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture(scope="session")
def pipeline(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Pipeline]:
    """One renderer for all tests that only want light."""
    with Pipeline(ArrayCache(tmp_path_factory.mktemp("surfaces"))) as shared:
        yield shared


@pytest.fixture
def ball_png(tmp_path: Path) -> Path:
    path = tmp_path / "ball.png"
    save_picture(path, draw_ball())
    return path


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> Run:
    """``lampblack ARGS...`` in this process."""

    def call(*arguments: object) -> Outcome:
        monkeypatch.setattr(sys, "argv", ["lampblack", *map(str, arguments)])
        monkeypatch.setenv("PYTHONSAFEPATH", "")
        handler = signal.getsignal(signal.SIGTERM)
        with warnings.catch_warnings(), pytest.raises(SystemExit) as stop:
            main()
        signal.signal(signal.SIGTERM, handler)
        shown = capfd.readouterr()
        assert "Traceback" not in shown.err + shown.out
        return Outcome(int(stop.value.code or 0), shown.out, shown.err)

    return call


@pytest.fixture
def unrendered(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Stands in for the renderer where a test is about everything else."""
    rendered: list[str] = []

    def light(self: Pipeline, *given: object, **named: object) -> Passes:
        rendered.append("frame")
        dark = np.zeros((1, 1, 3), np.float32)
        return Passes((), LightPasses(dark, dark))

    def height(
        self: SurfaceMaker, drawing: Drawing, *given: object
    ) -> tuple[NDArray[np.float32], tuple[Overlap, ...]]:
        return np.zeros(drawing.mask.shape, np.float32), ()

    monkeypatch.setattr(SurfaceMaker, "height", height)
    monkeypatch.setattr("lampblack.prepared.PreparedDrawing.surface", lambda *given: None)
    monkeypatch.setattr(Pipeline, "light", light)
    monkeypatch.setattr(
        "lampblack.finals.frame_files.composite", lambda drawing, *given, **named: drawing.pixels
    )
    return rendered
