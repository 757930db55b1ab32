"""What a shot will cost, from some of its drawings."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from lampblack.drawing import save_picture
from lampblack.finals import estimate as module
from lampblack.finals.estimate import Estimate, estimate
from lampblack.finals.render_shot import Outcome, RenderListener
from lampblack.finals.resolve import ResolvedJob
from lampblack.finals.settings import RenderSettings
from lampblack.pipeline import Pipeline
from lampblack.shot import ShotFrame
from support.command_line import Run

SECONDS = {"first": 20.0, "drawing": 4.0, "repeated": 0.5}


@pytest.fixture
def walk(tmp_path: Path) -> Path:
    """Ten drawings, each held for five frames."""
    folder = tmp_path / "walk"
    folder.mkdir()
    for number in range(50):
        picture = np.full((8, 8, 4), 255, np.uint8)
        picture[..., 0] = number // 5
        save_picture(folder / f"walk.{number + 1:04d}.png", picture)
    return folder


@pytest.fixture
def lit(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Frames are lit by a machine whose times are known; returns their names."""
    names: list[str] = []
    now = [100.0]
    monkeypatch.setattr(module.time, "perf_counter", lambda: now[0])

    def render_shot(
        job: ResolvedJob, pipeline: Pipeline, frames: Sequence[ShotFrame], listener: RenderListener
    ) -> Outcome:
        before = None
        for frame in frames:
            kind = (
                "first" if before is None else "repeated" if frame.drawing == before else "drawing"
            )
            now[0] += SECONDS[kind]
            before = frame.drawing
            names.append(frame.name)
            job.targets.folder.mkdir(exist_ok=True)
            (job.targets.folder / frame.name).write_bytes(bytes(1000))
            listener.on_frame(frame, None, kept=False)
        return Outcome(done=list(frames))

    monkeypatch.setattr(module, "render_shot", render_shot)
    return names


def test_a_shot_costs_its_drawings_and_little_for_frames_that_repeat_them(
    walk: Path, lit: list[str]
) -> None:
    shares: list[float] = []
    found = estimate(RenderSettings(inputs=(str(walk),), output="unused"), shares.append)
    # Four drawings in the middle, three frames of each.
    expected = [5 * drawing + held + 1 for drawing in range(3, 7) for held in range(3)]
    assert lit == [f"walk.{number:04d}.png" for number in expected]
    assert shares[-1] == 1
    assert found == Estimate(50, 10, 20.0, 4.0, 0.5, 50_000)
    assert found.seconds() == 20 + 9 * 4 + 40 * 0.5
    # Each of five machines has two drawings, ten frames.
    assert found.seconds(5) == 20 + 4 + 8 * 0.5
    assert not Path("unused").exists()


def test_the_command_says_it_in_words_and_numbers(walk: Path, lit: list[str], run: Run) -> None:
    said = run("estimate", walk, "--machines", "5")
    assert said.code == 0
    assert "50 frames of 10 drawings: about 0:00:28 on 5 machines." in said.out
    assert '"seconds":76.0' in run("estimate", walk, "--json").out
