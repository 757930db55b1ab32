"""A quick look from the sides: what faces the viewer is what was drawn, turned."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lampblack.drawing import load_picture, save_picture
from lampblack.finals.turntable import CLAY, PAPER, swing
from lampblack.render.client import RenderChild
from lampblack.render.passes import LightPasses, Passes
from lampblack.render.request import RenderRequest
from support.command_line import Run, files
from support.drawings import draw_ball

FULL = np.ones((8, 8, 3), np.float32)


class Daylight(RenderChild):
    """Unit light from everywhere: colours come back as they were drawn."""

    def start(self) -> None:
        pass

    def render(self, request: RenderRequest) -> Passes:
        none = LightPasses(0 * FULL, 0 * FULL)
        return Passes(tuple(none for _ in request.lights), LightPasses(FULL / 0.3, 0 * FULL))


def test_a_swing_loops_and_comes_back_the_way_it_went() -> None:
    angles = swing(32)
    assert (angles[0], angles[8], angles[24]) == (0, 40, -40)
    assert angles[1:16] == angles[1:16][::-1]
    assert len(set(angles)) == 17


@pytest.fixture
def two_sided(tmp_path: Path) -> Path:
    """A ball, red on the left and green on the right."""
    picture = draw_ball(120, (200, 60, 60))
    right = picture[:, 60:]
    right[(right[..., :3] == (200, 60, 60)).all(axis=2)] = 60, 200, 60, 255
    save_picture(tmp_path / "ball.png", picture)
    return tmp_path / "ball.png"


def test_the_relief_turns_with_its_colours(
    run: Run, tmp_path: Path, two_sided: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("lampblack.pipeline.RenderChild", lambda **given: Daylight())
    folder = tmp_path / "turned"
    done = run("turntable", two_sided, "-o", folder, "--pictures", 4, "--size", 96)
    assert done.code == 0, done.err
    assert files(folder) == {f"ball.turn.000{n}.png" for n in range(1, 5)}
    front, left, again, right = (
        load_picture(folder / f"ball.turn.000{n}.png")[..., :3].astype(int) for n in range(1, 5)
    )
    assert np.array_equal(front, again)
    assert (front[0, 0] == PAPER).all()
    middle = front.shape[1] // 2
    clay, lit = front[:, :middle], front[:, middle:]
    assert abs(int(np.median(clay[clay.shape[0] // 2])) - round(255 * CLAY)) < 4
    red, green = (lit == (200, 60, 60)).all(axis=2), (lit == (60, 200, 60)).all(axis=2)
    assert abs(int(red.sum()) - int(green.sum())) < 0.1 * red.sum()

    def share_of_red(picture: np.ndarray) -> float:
        seen = picture[:, middle:]
        reds, greens = (seen[..., k] - seen[..., 1 - k] > 100 for k in (0, 1))
        return float(reds.sum() / (reds.sum() + greens.sum()))

    assert share_of_red(left) > 0.55
    assert share_of_red(right) < 0.45


def test_a_gif_is_whole_and_loops(
    run: Run, tmp_path: Path, two_sided: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("lampblack.pipeline.RenderChild", lambda **given: Daylight())
    target = tmp_path / "ball.gif"
    assert run("turntable", two_sided, "-o", target, "--pictures", 8, "--size", 64).code == 0
    with Image.open(target) as image:
        assert (image.n_frames, image.info["loop"]) == (8, 0)  # type: ignore[attr-defined]
    assert run("turntable", two_sided, "-o", tmp_path / "ball.mp4").code == 1
    assert files(tmp_path) == {"ball.png", "ball.gif"}
