"""``lampblack-window``: the lamp on files of any drawing program, without that program."""

from __future__ import annotations

import zipfile
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.drawing import load_picture, save_picture
from lampblack.project.stack import ROLES_FIELD
from lampblack.scene import default_scene, encode_scene
from support.command_line import files
from support.drawings import draw_ball
from support.lamp import keep, project_in, settled, sidecar
from support.own_window import OwnWindow
from support.projects import png
from support.registration import luminance
from support.window import Display, wait_until

SIDE = 240
RED, GREEN = (200, 60, 40), (40, 180, 70)
LEFT, RIGHT = (60, 105, 20, 30), (160, 105, 20, 30)
"""Parts of the ball, away from the light: x, y, width, height."""


def save_over(path: Path, picture: NDArray[np.uint8]) -> None:
    """As paint programs do: under another name first."""
    save_picture(path.with_name("new.png"), picture)
    path.with_name("new.png").replace(path)


def brightness(window: OwnWindow, part: tuple[int, int, int, int]) -> float:
    return float(luminance(window.crop(*part)).mean())


@pytest.fixture(scope="module")
def ball(tmp_path_factory: pytest.TempPathFactory) -> Path:
    drawing = tmp_path_factory.mktemp("drawing") / "ball.png"
    save_picture(drawing, draw_ball(SIDE, RED))
    return drawing


@pytest.fixture(scope="module")
def window(
    display: Display, tmp_path_factory: pytest.TempPathFactory, ball: Path
) -> Iterator[OwnWindow]:
    with closing(OwnWindow(display, tmp_path_factory.mktemp("own"), ball)) as program:
        yield program


def test_the_light_of_a_picture_follows_the_lamp(window: OwnWindow) -> None:
    keep(window, "own window")
    window.drag_light(20, 110)
    left, right = brightness(window, LEFT), brightness(window, RIGHT)
    assert left > right + 0.03
    window.drag_light(220, 110)
    keep(window, "own window dragged")
    assert brightness(window, RIGHT) > right + 0.03
    assert brightness(window, LEFT) < left - 0.03
    # The lamp put away, the drawing is as it was drawn.
    window.set("lampblack.keep_light", "checked", False)
    window.trigger("lampblack.tool")
    plain = draw_ball(SIDE, RED)[LEFT[1], LEFT[0], :3]
    wait_until(lambda: np.abs(window.crop(*LEFT) - plain.astype(float)).max() <= 2, "no light")
    window.trigger("lampblack.tool")
    settled(window)


def test_a_picture_that_is_saved_again_is_lit_again(window: OwnWindow, ball: Path) -> None:
    save_over(ball, draw_ball(SIDE, GREEN))

    def is_green() -> bool:
        red, green, _ = window.crop(*LEFT).reshape(-1, 3).mean(axis=0)
        return bool(green > red)

    wait_until(is_green, "the new drawing")
    settled(window)
    ball.write_bytes(ball.read_bytes()[:300])
    wait_until(lambda: window.find("lampblack.panel.problem").get("seen"), "what is wrong")
    assert "ball.png" in window.value("lampblack.panel.problem.what", "text")
    assert is_green()
    keep(window, "own window problem")
    save_over(ball, draw_ball(SIDE, RED))
    wait_until(lambda: not is_green(), "the drawing after it")
    wait_until(lambda: not window.find("lampblack.panel.problem").get("seen"), "no problem")
    settled(window)


def test_the_light_is_saved_beside_the_drawing(window: OwnWindow, ball: Path) -> None:
    window.drag_light(120, 30)
    window.trigger("lampblack.window.save")
    wait_until(lambda: ball.with_name("ball.png.lampblack.json").exists(), "the light")


def test_a_sequence_is_lit_frame_by_frame_into_files(display: Display, tmp_path: Path) -> None:
    walk = tmp_path / "walk"
    walk.mkdir()
    for number, colour in ((11, RED), (13, GREEN)):
        save_picture(walk / f"walk.{number:04d}.png", draw_ball(96, colour))
    with closing(OwnWindow(display, tmp_path / "own", walk)) as window:
        assert window.value("lampblack.window.frame", "value") == 11
        window.key("period", "period")
        wait_until(lambda: window.value("lampblack.window.frame", "value") == 13, "frame 13")
        settled(window)
        keep(window, "own window sequence")
        assert not window.value("lampblack.panel.hide", "enabled")
        window.trigger("lampblack.render")
        lit = tmp_path / "walk_lit"
        wanted = {f"walk.{number:04d}.png" for number in (11, 12, 13)}
        wait_until(lambda: lit.exists() and files(lit) >= wanted, "lit frames", 180)
        assert files(walk) == {"walk.0011.png", "walk.0013.png"}
        middle = [load_picture(lit / name)[48, 48, :3].astype(int) for name in sorted(wanted)]
        assert middle[0][0] > middle[0][1]
        assert middle[2][1] > middle[2][0]
        assert np.array_equal(middle[0], middle[1])


def write_layers(path: Path) -> None:
    """A ball with a smaller one on a layer of its own in front, as OpenRaster."""
    layers = {"Hat": (draw_ball(48, GREEN), 36, 4), "Body": (draw_ball(120, RED), 0, 0)}
    stack = "".join(
        f'<layer name="{name}" src="data/{name}.png" x="{x}" y="{y}"/>'
        for name, (_, x, y) in layers.items()
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", "image/openraster")
        archive.writestr("stack.xml", f'<image w="120" h="120"><stack>{stack}</stack></image>')
        for name, (picture, _, _) in layers.items():
            archive.writestr(f"data/{name}.png", png(picture))


def layer_rows(window: OwnWindow) -> set[str]:
    return {name.rpartition(".")[2] for name in window.names("lampblack.panel.layer.")}


def test_layers_of_a_drawing_have_roles(display: Display, tmp_path: Path) -> None:
    drawing = tmp_path / "hero.ora"
    write_layers(drawing)
    roles = {ROLES_FIELD: {"Hat": "background", "Body": "character"}}
    scene = replace(default_scene(120, 120), extra=roles)
    sidecar(drawing).write_bytes(encode_scene(scene))
    with closing(OwnWindow(display, tmp_path / "own", drawing)) as window:
        assert layer_rows(window) == {"Hat", "Body"}
        keep(window, "own window layers")
        hat, body = window.crop(55, 20, 10, 10), window.crop(20, 70, 10, 10)
        assert np.abs(hat - np.array(GREEN, float)).max() <= 2
        assert np.abs(body - np.array(RED, float)).max() > 10


def test_a_project_of_pencil2d_needs_no_pencil2d(display: Display, tmp_path: Path) -> None:
    with closing(OwnWindow(display, tmp_path / "own", project_in(tmp_path))) as window:
        assert layer_rows(window) == {"Lamplighter"}
        window.key("period")
        wait_until(lambda: window.value("lampblack.window.frame", "value") == 2, "frame 2")
        settled(window)
        keep(window, "own window project")
