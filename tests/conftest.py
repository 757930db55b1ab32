"""What several tests share: a small drawing, and caches that touch nobody's home."""

from __future__ import annotations

import signal
import sys
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.cache import ArrayCache
from lampblack.cli import main
from lampblack.drawing import save_picture
from lampblack.pipeline import Pipeline
from lampblack.render import LightPasses, Passes


@pytest.fixture(autouse=True)
def own_cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))


@pytest.fixture(scope="session")
def pipeline(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Pipeline]:
    """One renderer for all tests that only want light."""
    with Pipeline(ArrayCache(tmp_path_factory.mktemp("surfaces"))) as shared:
        yield shared


def draw_ball(
    size: int = 160, fill: tuple[int, int, int] = (220, 120, 60), canvas: int | None = None
) -> NDArray[np.uint8]:
    """(canvas, canvas, 4) uint8: an inked, anti-aliased ball on a transparent canvas."""
    canvas = canvas or size
    rows, columns = np.mgrid[0:canvas, 0:canvas] + 0.5 - canvas / 2
    distance = np.hypot(rows, columns)
    radius, line = size * 0.4, max(2.0, size / 60)
    cover = np.clip(radius - distance + 0.5, 0, 1)
    inside = np.clip(radius - line - distance + 0.5, 0, 1)[..., None]
    colour = np.array(fill) * inside + np.array([20, 16, 24]) * (1 - inside)
    return np.dstack([np.round(colour), np.round(255 * cover)]).astype(np.uint8)


@pytest.fixture
def ball_png(tmp_path: Path) -> Path:
    path = tmp_path / "ball.png"
    save_picture(path, draw_ball())
    return path


@dataclass(frozen=True)
class Outcome:
    code: int
    out: str
    err: str


Run = Callable[..., Outcome]


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> Run:
    """``lampblack ARGS...`` in this process."""

    def call(*arguments: object) -> Outcome:
        monkeypatch.setattr(sys, "argv", ["lampblack", *map(str, arguments)])
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

    monkeypatch.setattr(Pipeline, "surface", lambda *given: None)
    monkeypatch.setattr(Pipeline, "light", light)
    monkeypatch.setattr(
        "lampblack.finals.light.composite", lambda drawing, passes, scene: drawing.pixels
    )
    return rendered


def files(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}
