"""What the turntable and the .blend leave out of a scene is said."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lampblack.atomic import atomic_file
from lampblack.drawing import save_picture
from lampblack.render.client import RenderChild
from lampblack.render.passes import LightPasses, Passes
from lampblack.render.request import RenderRequest
from support.command_line import Run
from support.drawings import draw_ball

FULL = np.ones((8, 8, 3), np.float32)


class Unrendered(RenderChild):
    """Writes empty files and gives even light."""

    def start(self) -> None:
        pass

    def render(self, request: RenderRequest) -> Passes:
        light = LightPasses(FULL, FULL)
        return Passes(tuple(light for _ in request.lights), light)

    def save_blend(self, *given: Any) -> None:
        with atomic_file(given[-1]) as file:
            file.write(b"blend")


@pytest.mark.parametrize("emission", [0, 2])
@pytest.mark.parametrize(
    ("command", "name", "words"),
    [("turntable", "a.gif", "The turntable"), ("export", "a.blend", "a.blend")],
)
def test_light_that_emissive_colours_throw(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str, name: str, words: str,
    emission: int,
) -> None:  # fmt: skip
    for module in ("pipeline", "finals.scene_file"):
        monkeypatch.setattr(f"lampblack.{module}.RenderChild", lambda **_: Unrendered())
    save_picture(tmp_path / "ball.png", draw_ball(64, (200, 60, 60)))
    scene = tmp_path / "scene.json"
    scene.write_text(
        '{"canvas": {"width": 64, "height": 64}, "lights": [],'
        f' "materials": {{"#c83c3c": {{"emission": {emission}}}}}}}'
    )
    given = ("--pictures", 4, "--size", 64) if command == "turntable" else ()
    target = tmp_path / name
    done = run(command, tmp_path / "ball.png", "-o", target, "--scene", scene, *given)
    assert done.code == 0, done.err
    said = " ".join(done.err.split())
    assert (f"{words} leaves out the light that emissive colours throw." in said) == bool(emission)
