"""The live worker through its real socket: looks, refinement, order, jobs, two clients."""

from __future__ import annotations

import os
import stat
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lampblack.composite.byte_layers import premultiplied
from lampblack.drawing import load_picture, save_picture
from lampblack.protocol import (
    Crop,
    Done,
    ErrorMessage,
    FrameDone,
    GetPalette,
    Image,
    Palette,
    Render,
    Status,
    View,
)
from lampblack.scene import Floor, LightKey, Material, Scene, default_scene, encode_scene
from lampblack.service.client import Client, Worker
from support.command_line import Run
from support.drawings import draw_ball

SIZE = 160
WHOLE = (0.0, 0.0, float(SIZE), float(SIZE))


@pytest.fixture
def client(worker: Worker) -> Iterator[Client]:
    with worker.connect() as client:
        client.hello()
        yield client


def lit_from(x: float, **more: object) -> Scene:
    scene = default_scene(SIZE, SIZE)
    return replace(scene, lights=(replace(scene.lights[0], x=x, **more),))  # type: ignore[arg-type]


def converge(client: Client, revision: int) -> np.ndarray:
    _, picture = client.picture(60, lambda i: i.converged and i.revision == revision)
    return picture.astype(int)


def test_only_its_user_gets_at_the_socket(worker: Worker) -> None:
    socket = Path(worker.endpoint().removeprefix("ipc://"))
    assert len(os.fsencode(socket)) <= 107
    assert stat.S_IMODE(socket.parent.stat().st_mode) == 0o700
    assert stat.S_IMODE(worker.connection.stat().st_mode) == 0o600


def test_a_look_is_shown_coarse_at_once_then_finer_then_still(client: Client) -> None:
    client.announce(1, draw_ball(SIZE))
    revision = client.set_scene(lit_from(20))
    request = client.look(1, (SIZE, SIZE), WHOLE)
    picture = converge(client, revision)
    images = [message for message in client.seen if isinstance(message, Image)]
    assert [i.pass_ for i in images] == list(range(len(images)))
    assert len(images) >= 3
    assert {i.request for i in images} == {request}
    left, right = picture[60:100, 30:50, :3].mean(), picture[60:100, -50:-30, :3].mean()
    assert left > 1.2 * right
    assert not picture[0, 0].any()

    with pytest.raises(TimeoutError):
        client.picture(1.5)  # converged means still
    moved = client.set_scene(lit_from(140))
    assert client.picture(30)[0].revision == moved
    picture = converge(client, moved)
    left, right = picture[60:100, 30:50, :3].mean(), picture[60:100, -50:-30, :3].mean()
    assert right > 1.2 * left


def test_nothing_older_follows_something_newer(client: Client) -> None:
    client.announce(1, draw_ball(SIZE))
    client.look(1, (SIZE, SIZE), WHOLE)
    until = time.monotonic() + 60

    def shown() -> list[tuple[int, int]]:
        return [(i.revision, i.pass_) for i in client.seen if isinstance(i, Image)]

    while client.revision < 200 or (len(shown()) <= 10 and time.monotonic() < until):
        step = client.revision
        revision = client.set_scene(lit_from(step % 100, power=1 + step % 3))
        while client.receive(0.005):
            pass
    converge(client, revision)
    assert shown() == sorted(shown())
    assert len(shown()) > 10


def test_colour_and_power_need_no_render(client: Client) -> None:
    """Light is linear: in the shadow-free, unclipped range twice the power is twice the light."""
    client.announce(1, draw_ball(SIZE, (60, 60, 60)))
    dim = client.set_scene(lit_from(80, power=0.5))
    client.look(1, (SIZE, SIZE), WHOLE)
    converge(client, dim)
    brighter = client.set_scene(lit_from(80, power=1.0, colour="#ff8080"))
    image, _ = client.picture(30, lambda i: i.revision == brighter)
    assert image.converged
    assert image.pass_ == 0


def test_a_crop_is_shown_at_device_resolution(client: Client) -> None:
    picture = draw_ball(SIZE)
    client.announce(1, picture)
    revision = client.set_scene(lit_from(80))
    client.look(1, (120, 80), (-20.0, 0.0, 60.0, 40.0))
    seen = converge(client, revision)
    assert seen.shape == (80, 120, 4)
    assert not seen[:, :40].any()
    alpha = np.repeat(np.repeat(picture[:40, :40, 3], 2, 0), 2, 1)
    assert np.abs(seen[:, 40:, 3] - alpha).mean() < 4


def test_normals_relief_and_palette(client: Client) -> None:
    digest = client.announce(3, draw_ball(SIZE, (220, 120, 60)))
    client.send(GetPalette(request=client.next_request(), frame=3))
    palette, _ = client.wait_for(Palette)
    assert palette.digest == digest
    assert palette.swatches[0].colour == "#dc783c"
    crop = Crop(x=0, y=0, width=SIZE, height=SIZE)
    for show in ("normals", "relief"):
        client.send(
            View(
                request=client.next_request(),
                frame=3,
                show=show,
                crop=crop,
                width=SIZE,
                height=SIZE,
            )
        )
        _, planes = client.wait_for(Image, 60, lambda i, kind=show: i.converged and i.show == kind)
        seen = planes["picture"].astype(int)
        if show == "normals":
            assert seen[80, 40, 0] < 110 < 145 < seen[80, 120, 0]
            assert seen[40, 80, 1] > 145 > 110 > seen[120, 80, 1]
        else:
            assert seen[80, 80, 0] > seen[80, 24, 0] + 50


def test_a_job_writes_what_the_command_line_writes(client: Client, tmp_path: Path) -> None:
    from typer.testing import CliRunner

    from lampblack.cli.app import app

    source = tmp_path / "drawn"
    source.mkdir()
    scene = lit_from(30)
    (tmp_path / "scene.json").write_bytes(encode_scene(scene))
    for number in (1, 2):
        picture = draw_ball(SIZE - 20 * number, canvas=SIZE)
        save_picture(source / f"ball.{number:04d}.png", picture)
        client.announce(number, picture)
    client.set_scene(scene)
    request = client.next_request()
    output = str(tmp_path / "job" / "ball.%04d.png")
    client.send(Render(request=request, frames="1-2", output=output, quality="low"))
    done, _ = client.wait_for(Done, 120)
    assert (done.outcome, done.frames_done, done.frames_failed) == ("finished", 2, 0)
    assert [m.frame for m in client.seen if isinstance(m, FrameDone)] == [1, 2]
    arguments = ["render", str(source), "-o", str(tmp_path / "cli")]
    arguments += ["--scene", str(tmp_path / "scene.json"), "--quality", "low"]
    assert CliRunner().invoke(app, arguments).exit_code == 0
    for number in (1, 2):
        name = f"ball.{number:04d}.png"
        theirs, ours = (load_picture(tmp_path / folder / name) for folder in ("job", "cli"))
        assert np.array_equal(theirs, ours)

    # Only files that are up to date are kept: at another quality, they are rendered again.
    for quality, kept in (("low", True), ("medium", False)):
        again = Render(
            request=client.next_request(),
            frames="1-2",
            output=output,
            quality=quality,
            keep_finished=True,
        )
        client.send(again)
        client.wait_for(Done, 120)
        frames = [m.kept for m in client.seen if isinstance(m, FrameDone)]
        assert frames[-2:] == [kept, kept]


def test_a_converged_preview_agrees_with_the_final(
    client: Client, tmp_path: Path, run: Run
) -> None:
    """Through the socket and through ``lampblack render``: over all pixels the two differ by half a
    level of 255 on average, and 999 of 1,000 by 12 levels at most."""
    size = 320
    picture = draw_ball(200, (200, 120, 60), canvas=size)
    scene = default_scene(size, size)
    scene = replace(
        scene,
        lights=(replace(scene.lights[0], x=60.0, y=60.0),),
        materials={"#c8783c": Material(glossy=True, gloss=0.3)},
        floor=Floor(250.0),
        quality="final",
    )
    save_picture(tmp_path / "ball.png", picture)
    (tmp_path / "scene.json").write_bytes(encode_scene(scene))
    command = ("render", tmp_path / "ball.png", "-o", tmp_path / "lit")
    assert run(*command, "--scene", tmp_path / "scene.json").code == 0
    final = premultiplied(load_picture(tmp_path / "lit" / "ball.png")).astype(int)

    client.announce(1, picture)
    revision = client.set_scene(scene)
    client.look(1, (size, size), (0.0, 0.0, float(size), float(size)))
    apart = np.abs(converge(client, revision) - final)
    lit = np.abs(final - premultiplied(picture))
    assert lit.max() > 60
    assert (lit[..., 3] > 0).sum() > 1000, "the floor's shadow"
    assert apart.mean() < 0.5
    assert np.quantile(apart.max(axis=2), 0.999) <= 12


def test_all_frames_are_lit_while_nothing_else_is_to_do(client: Client) -> None:
    for number in (1, 2, 3):
        client.announce(number, draw_ball(SIZE - 10 * number, (200, 90, 90), canvas=SIZE))
    revision = client.set_scene(lit_from(50))
    client.look(1, (SIZE, SIZE), WHOLE)
    converge(client, revision)
    client.wait_for(Status, 60, lambda s: s.frames_lit == 3)
    client.look(3, (SIZE, SIZE), WHOLE)
    image, _ = client.picture(10, lambda i: i.frame == 3)
    assert image.spp >= 4


def test_keyed_lights_move_from_frame_to_frame_in_previews_and_jobs(
    client: Client, tmp_path: Path
) -> None:
    picture = draw_ball(SIZE - 16, (90, 200, 90), canvas=SIZE)
    for number in (1, 2, 3):
        client.announce(number, picture)
    light = lit_from(80).lights[0]
    keys = tuple(LightKey(n, x, light.y, light.z, light.size) for n, x in ((1, 0), (3, SIZE)))
    revision = client.set_scene(lit_from(80, keys=keys))

    def lean(shown: np.ndarray) -> float:
        """How much brighter the right side is than the left."""
        return float(shown[:, 100:130].mean() - shown[:, 30:60].mean())

    leans = []
    for number in (1, 2, 3):
        client.look(number, (SIZE, SIZE), WHOLE)
        _, shown = client.picture(
            60, lambda i, n=number: i.converged and i.revision == revision and i.frame == n
        )
        leans.append(lean(shown.astype(int)))
    assert leans[0] < -5 < 5 < leans[2]
    assert leans[0] < leans[1] < leans[2]
    # One drawing, but three frames to light.
    client.wait_for(Status, 60, lambda s: s.frames_lit == 3)

    output = str(tmp_path / "%04d.png")
    client.send(Render(request=client.next_request(), frames="1-3", output=output, quality="low"))
    client.wait_for(Done, 120)
    rendered = [lean(load_picture(tmp_path / f"{n:04d}.png").astype(int)) for n in (1, 2, 3)]
    assert rendered[0] < -5 < 5 < rendered[2]


def test_blank_frames_and_unknown_ones_are_told(client: Client) -> None:
    client.set_scene(lit_from(50))
    client.look(7, (SIZE, SIZE), WHOLE)
    error, _ = client.wait_for(ErrorMessage)
    assert (error.code, error.frame) == ("unknown_frame", 7)
    client.announce(7, np.zeros((SIZE, SIZE, 4), np.uint8))
    error, _ = client.wait_for(ErrorMessage)
    assert (error.code, error.frame) == ("nothing_drawn", 7)


def test_clients_do_not_see_each_other(worker: Worker, client: Client) -> None:
    with worker.connect() as other:
        other.hello()
        client.announce(1, draw_ball(SIZE, (220, 40, 40)))
        other.announce(1, draw_ball(SIZE, (40, 40, 220)))
        mine, theirs = client.set_scene(lit_from(80)), other.set_scene(lit_from(80))
        client.look(1, (SIZE, SIZE), WHOLE)
        other.look(1, (SIZE, SIZE), WHOLE)
        red, blue = converge(client, mine)[80, 80], converge(other, theirs)[80, 80]
        assert red[0] > red[2]
        assert blue[2] > blue[0]
