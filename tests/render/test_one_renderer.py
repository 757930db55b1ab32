"""A shot is the same to the last byte, whoever renders it: the command line or a render job."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from lampblack.protocol import Done, ErrorMessage, FrameDone, Render
from lampblack.scene import Floor, LightKey, Scene, decode_scene, default_scene, encode_scene
from lampblack.service.client import Client, Worker
from support.command_line import Run
from support.drawings import draw_ball
from support.paths import ROOT
from support.projects import document, image, layer, png, write_project


@pytest.fixture
def client(worker: Worker) -> Iterator[Client]:
    with worker.connect() as client:
        client.hello()
        yield client


def example(folder: Path) -> tuple[Path, Scene]:
    """The example project, under the scene it comes with."""
    source = ROOT / "examples" / "lamplighter.pclx"
    shutil.copy(source, folder / source.name)
    scene = decode_scene(source.with_name(source.name + ".lampblack.json").read_bytes())
    return folder / source.name, scene


def moving(folder: Path) -> tuple[Path, Scene]:
    """A moving camera, a keyed light, a floor, a held drawing and a layer that is not lit."""
    camera = (
        '<camera frame="1" r="0" s="1" dx="0" dy="0"/>'
        '<camera frame="4" r="20" s="1.5" dx="12" dy="-4"/>'
    )
    balls = [image(1, "a.png", -40, -40), image(3, "b.png", -44, -40)]
    layers = [layer(2, "sky", [image(1, "sky.png", -48, -48)]), layer(3, "ball", balls)]
    pictures = {
        "a.png": png(draw_ball(80)),
        "b.png": png(draw_ball(80, (90, 160, 60))),
        "sky.png": png(draw_ball(96, (40, 60, 200))),
    }
    xml = document(layers, camera=camera, size=(96, 96))
    scene = default_scene(96, 96)
    light = scene.lights[0]
    keys = tuple(
        LightKey(n, x, 20, 60, 30, colour)
        for n, x, colour in ((1, 10, "#ffd0a0"), (4, 90, "#a0d0ff"))
    )
    scene = replace(
        scene,
        lights=(replace(light, keys=keys), replace(light, x=50.0, power=0.4)),
        floor=Floor(80.0),
        extra={"pencil2d_layers": {"sky": "background"}},
    )
    return write_project(folder / "moving.pclx", xml, pictures), scene


@pytest.mark.parametrize(("make", "frames"), [(example, "1-4"), (moving, "1-4")])
@pytest.mark.parametrize("kind", ["png", "exr"])
def test_a_job_writes_the_bytes_of_the_command_line(
    worker: Worker,
    client: Client,
    tmp_path: Path,
    run: Run,
    monkeypatch: pytest.MonkeyPatch,
    make: object,
    frames: str,
    kind: str,
) -> None:
    # As on a user's machine, where both have one cache.
    monkeypatch.setenv("XDG_CACHE_HOME", str(worker.connection.parent / "cache"))
    project, scene = make(tmp_path)  # type: ignore[operator]
    (tmp_path / "scene.json").write_bytes(encode_scene(scene))
    pattern = tmp_path / "cli" / f"lit.%04d.{kind}"
    options = ("--frames", frames, "--quality", "low", "--layers", "lit")
    assert (
        run("render", project, "-o", pattern, "--scene", tmp_path / "scene.json", *options).code
        == 0
    )

    client.set_scene(scene)
    output = str(tmp_path / "job" / f"lit.%04d.{kind}")
    job = Render(
        request=client.next_request(),
        frames=frames,
        output=output,
        quality="low",
        project=str(project),
    )
    client.send(job)
    done, _ = client.wait_for(Done, 120)
    assert (done.outcome, done.frames_done, done.frames_total) == ("finished", 4, 4)
    for number in range(1, 5):
        name = f"lit.{number:04d}.{kind}"
        assert (tmp_path / "job" / name).read_bytes() == (tmp_path / "cli" / name).read_bytes()

    # What the command line made, a job leaves alone.
    again = Render(
        request=client.next_request(),
        frames=frames,
        output=str(pattern),
        quality="low",
        project=str(project),
        keep_finished=True,
    )
    client.send(again)
    client.wait_for(Done, 60)
    assert [m.kept for m in client.seen if isinstance(m, FrameDone)][-4:] == [True] * 4


def test_a_project_that_cannot_be_read_fails_the_job(client: Client, tmp_path: Path) -> None:
    client.set_scene(default_scene(96, 96))
    (tmp_path / "torn.pclx").write_bytes(b"PK")
    job = Render(
        request=client.next_request(),
        frames="1",
        output=str(tmp_path / "%04d.png"),
        project=str(tmp_path / "torn.pclx"),
    )
    client.send(job)
    error, _ = client.wait_for(ErrorMessage)
    assert "torn.pclx" in error.what
    done, _ = client.wait_for(Done)
    assert done.outcome == "failed"
