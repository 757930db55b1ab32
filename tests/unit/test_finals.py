"""Finals: what is written, what is left alone, and what the layers add up to."""

from __future__ import annotations

import json
import tracemalloc
from dataclasses import replace
from pathlib import Path

import numpy as np
import OpenEXR
import pytest
from numpy.typing import NDArray

from lampblack.colour import linear
from lampblack.drawing import decompose_drawing, load_picture, save_picture
from lampblack.errors import LampblackError, RenderError
from lampblack.finals.targets import Targets
from lampblack.pipeline import Pipeline
from lampblack.render.client import RenderChild
from lampblack.render.passes import LightPasses, Passes
from lampblack.scene import (
    Ambient,
    AreaLight,
    Floor,
    LightKey,
    Material,
    Scene,
    decode_scene,
    default_scene,
    encode_scene,
)
from lampblack.shot import ShotFrame
from support.command_line import Run, files
from support.drawings import draw_ball
from support.projects import document, image, layer, png, walk, write_project

Floats = NDArray[np.float32]


def test_a_project_is_lit_under_its_sidecar_and_only_what_changed_again(
    run: Run, tmp_path: Path, unrendered: list[str]
) -> None:
    project, out = walk(tmp_path, [1, 2, 1, 2, 3]), tmp_path / "lit"
    sidecar = tmp_path / "walk.pclx.lampblack.json"
    sidecar.write_bytes(encode_scene(replace(default_scene(96, 96), quality="final")))
    assert run("render", project, "-o", out, "--contact-sheet", tmp_path / "sheet.png").code == 0
    assert files(out) == {f"walk.{n:04d}.png" for n in range(1, 6)}
    assert len(unrendered) == 3
    assert load_picture(out / "walk.0003.png").shape == (96, 96, 4)

    again = run("render", project, "-o", out)
    assert "5 of them from before" in again.err
    assert len(unrendered) == 3
    (out / "walk.0002.png").unlink()
    (out / "walk.0004.png").write_bytes((out / "walk.0005.png").read_bytes()[:-40])
    assert run("render", project, "-o", out).code == 0
    assert len(unrendered) == 4
    assert run("render", project, "-o", out, "--again").code == 0
    assert len(unrendered) == 7
    # Another scene makes other frames.
    assert run("render", project, "-o", out, "--light", "1,2,3", "--frames", "1,3").code == 0
    assert len(unrendered) == 8
    sidecar.write_text("{")
    assert "scene" in run("render", project, "-o", out).err


def test_broken_frames_of_a_project_are_told_and_the_others_lit(
    run: Run, tmp_path: Path, unrendered: list[str]
) -> None:
    keys = [image(1, "ball.png", -40, -40), image(3, "bad.png"), image(4, "ball.png", -40, -40)]
    xml = document([layer(2, "ball", keys)], size=(96, 96))
    pictures = {"ball.png": png(draw_ball(80)), "bad.png": b"\x89PNG"}
    project = write_project(tmp_path / "w.pclx", xml, pictures)
    done = run("render", project, "-o", tmp_path / "lit")
    assert done.code == 1
    assert "w.0003.png: " in done.err
    assert "bad.png of frame 3" in done.err
    assert files(tmp_path / "lit") == {f"w.{n:04d}.png" for n in (1, 2, 4)}
    assert len(unrendered) == 1


def test_frames_that_the_artist_left_blank_are_not_warned_of(
    run: Run, tmp_path: Path, unrendered: list[str]
) -> None:
    keys = [image(1, "ball.png", -40, -40), image(3, "never drawn.png")]
    xml = document([layer(2, "ball", keys)], size=(96, 96))
    project = write_project(tmp_path / "w.pclx", xml, {"ball.png": png(draw_ball(80))})
    done = run("render", project, "-o", tmp_path / "lit")
    assert (done.code, "warning" in done.err) == (0, False)
    assert not load_picture(tmp_path / "lit" / "w.0003.png").any()


def test_options_that_do_not_fit_a_project_are_told(
    run: Run, tmp_path: Path, unrendered: list[str], ball_png: Path
) -> None:
    project, out = walk(tmp_path, [1]), ("-o", tmp_path / "lit")
    for words in (
        (ball_png,),
        ("--mask", ball_png),
        ("--camera", "Crane"),
        ("--character", "ball", "--line", "ball"),
        ("--background", "ball"),
        ("--frames", "7"),
    ):
        assert run("render", project, *words, *out).code == 1, words
    assert not unrendered


@pytest.mark.parametrize(
    ("pattern", "name"),
    [
        ("shot_v001.%04d.png", "shot_v001.0007.png"),
        ("shot%03d.exr", "shot007.exr"),
        ("shot.####.EXR", "shot.0007.EXR"),
        ("%d_shot.png", "7_shot.png"),
        ("shot..png", "shot.0007.png"),
        ("folder", "walk.0007.png"),
        ("dots.in.folder", "walk.0007.png"),
    ],
)
def test_names_keep_the_frame_number(tmp_path: Path, pattern: str, name: str) -> None:
    targets = Targets(str(tmp_path / pattern))
    frame = ShotFrame(7, "walk.0007.png", "")
    targets.prepare([frame, ShotFrame(12, "walk.0012.png", "")], [])
    assert targets.path(frame).name == name
    assert targets.kind == ("exr" if name.lower().endswith("exr") else "png")


@pytest.mark.parametrize(
    ("pattern", "kind"),
    [("a.%04d.tif", None), ("a.%04d.%02d.png", None), ("a.%04d.png", "exr"), ("a.png", None)],
)
def test_patterns_that_cannot_be_used_are_told(
    tmp_path: Path, pattern: str, kind: str | None
) -> None:
    frames = [ShotFrame(n, f"w.{n}.png", "") for n in (1, 2)]
    with pytest.raises(LampblackError):
        Targets(str(tmp_path / pattern), kind).prepare(frames, [])  # type: ignore[arg-type]


def test_patterns_do_not_overwrite_what_they_read(
    run: Run, tmp_path: Path, unrendered: list[str]
) -> None:
    for number in (1, 2):
        save_picture(tmp_path / f"a.{number:04d}.png", draw_ball(64))
    inputs = tmp_path / "a.%04d.png"
    assert run("render", inputs, "-o", inputs).code == 1
    assert run("render", inputs, "-o", tmp_path / "lit.%04d.png").code == 0
    assert len(files(tmp_path)) == 4


def one_colour(strength: float, shape: tuple[int, int] = (64, 64)) -> LightPasses:
    ramp = np.linspace(0, strength, shape[1], dtype=np.float32)
    light = np.broadcast_to(ramp[None, :, None], (*shape, 3)).copy()
    return LightPasses(light, light[:, ::-1].copy(), light * 0.5, light)


class FakeChild(RenderChild):
    """Light by formula instead of Cycles."""

    asked: list[tuple[int, bool]]

    def render(self, request: object) -> Passes:
        lights = request.lights  # type: ignore[attr-defined]
        self.__dict__.setdefault("asked", []).append((len(lights), request.ambient))  # type: ignore[attr-defined]
        return Passes(tuple(one_colour(light.x / 50) for light in lights), one_colour(0.4))


@pytest.fixture
def fake_child(monkeypatch: pytest.MonkeyPatch) -> FakeChild:
    child = FakeChild()
    monkeypatch.setattr("lampblack.pipeline.RenderChild", lambda **given: child)
    return child


def lit_scene() -> Scene:
    materials = {"#dc783c": Material(glossy=True, gloss=0.4)}
    return replace(
        default_scene(96, 96),
        lights=(AreaLight(30, 20, 60, colour="#ffd0a0"), AreaLight(70, 20, 60, power=0.5)),
        ambient=Ambient(strength=0.2),
        materials=materials,
        floor=Floor(80),
    )


def planes(path: Path) -> dict[str, NDArray[np.floating]]:
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: channel.pixels for name, channel in file.channels().items()}


def stacked(found: dict[str, NDArray[np.floating]], name: str, letters: str = "RGB") -> Floats:
    prefix = f"{name}." if name else ""
    return np.stack([found[prefix + letter].astype(np.float32) for letter in letters], axis=2)


def test_layers_of_an_exr_add_up_to_the_picture(
    run: Run, tmp_path: Path, fake_child: FakeChild
) -> None:
    scene, drawing = tmp_path / "scene.json", tmp_path / "ball.0012.png"
    scene.write_bytes(encode_scene(lit_scene()))
    save_picture(drawing, draw_ball(96))
    assert run("render", drawing, "-o", tmp_path / "a.%04d.exr", "--scene", scene).code == 0
    assert run("render", drawing, "-o", tmp_path / "lit", "--scene", scene).code == 0
    found = planes(tmp_path / "a.0012.exr")

    total = stacked(found, "diffuse") + stacked(found, "glossy")
    sources = [stacked(found, f"light{n}") for n in range(1, 5)] + [stacked(found, "ambient")]
    assert np.abs(total - sum(sources)).max() < 4e-3
    assert not sources[2].any()
    assert sources[0].max() > 0.1

    beauty = stacked(found, "", "RGBA")
    picture = load_picture(tmp_path / "lit" / "ball.0012.png") / np.float32(255)
    assert np.abs(beauty[..., 3] - picture[..., 3]).max() < 3e-3
    assert np.abs(beauty[..., :3] - linear(picture[..., :3]) * picture[..., 3:]).max() < 6e-3
    # Well inside the fill, where nothing is bent, the picture is its light.
    drawn = decompose_drawing(draw_ball(96))
    plain = (drawn.ink == 0) & (drawn.coverage == 1) & (total.max(axis=2) < 0.8)
    assert plain.sum() > 500
    assert np.abs(beauty[..., :3] - total)[plain].max() < 4e-3

    normal = stacked(found, "normal", "XYZ")
    assert np.allclose(np.linalg.norm(normal[drawn.mask], axis=1), 1, atol=2e-3)
    assert (found["depth.Z"][drawn.mask] != 0).any()
    assert not found["depth.Z"][~drawn.mask].any()
    assert np.allclose(stacked(found, "shadow")[:, 8:], 0.5, atol=0.01)
    types = {name: plane.dtype.name for name, plane in found.items()}
    assert types.pop("depth.Z") == "float32"
    assert set(types.values()) == {"float16"}
    assert (
        "1 of them from before"
        in run("render", drawing, "-o", tmp_path / "a.%04d.exr", "--scene", scene).err
    )


def test_an_exr_of_a_moved_camera_is_moved_in_all_its_layers(
    run: Run, tmp_path: Path, fake_child: FakeChild
) -> None:
    camera = (
        '<camera frame="1" r="0" s="1" dx="0" dy="0"/>'
        '<camera frame="2" r="90" s="1" dx="8" dy="0"/>'
    )
    xml = document([layer(2, "b", [image(1, "b.png", -40, -40)])], camera=camera, size=(96, 96))
    project = write_project(tmp_path / "w.pclx", xml, {"b.png": png(draw_ball(80))})
    assert run("render", project, "-o", tmp_path / "w.%04d.exr").code == 0
    assert len(fake_child.asked) == 1
    first, second = (planes(tmp_path / f"w.000{n}.exr") for n in (1, 2))

    def turned(layer: Floats) -> Floats:
        """As the camera turns: clockwise, and 8 pixels right is then 8 pixels down."""
        return np.roll(np.rot90(layer, -1), 8, axis=0)

    for name in ("", "diffuse", "albedo", "ambient"):
        before, after = stacked(first, name), stacked(second, name)
        assert np.abs(turned(before) - after)[12:].max() < 0.02, name
    x, y = turned(first["normal.X"]), turned(first["normal.Y"])
    inside = turned(first["A"]) > 0.99
    # What looked right looks down; y counts upwards.
    assert np.abs(second["normal.X"] - y)[inside].max() < 0.02
    assert np.abs(second["normal.Y"] + x)[inside].max() < 0.02


def test_keyed_lights_move_and_what_stands_still_is_not_traced_again(
    run: Run, tmp_path: Path, fake_child: FakeChild
) -> None:
    project = walk(tmp_path, [1, 1, 1])
    keys = tuple(LightKey(n, 10 + 30 * n, 20, 60) for n in (1, 3))
    lights = (AreaLight(0, 0, 60, keys=keys), AreaLight(50, 20, 60))
    scene = replace(default_scene(96, 96), lights=lights)
    (tmp_path / "walk.pclx.lampblack.json").write_bytes(encode_scene(scene))
    assert run("render", project, "-o", tmp_path / "lit").code == 0
    assert fake_child.asked == [(2, True), (1, False), (1, False)]
    pictures = [load_picture(tmp_path / "lit" / f"walk.000{n}.png") for n in (1, 2, 3)]
    means = [float(p[..., :3].mean()) for p in pictures]
    assert means[0] < means[1] < means[2]


def test_a_renderer_that_is_lost_once_costs_no_frame(
    run: Run, tmp_path: Path, fake_child: FakeChild, monkeypatch: pytest.MonkeyPatch
) -> None:
    project, lost = walk(tmp_path, [1, 2, 1]), []
    original = FakeChild.render

    def render(self: FakeChild, request: object) -> Passes:
        lost.append(request)
        if len(lost) in (2, 4, 5, 6):
            raise RenderError("lost")
        return original(self, request)

    monkeypatch.setattr(FakeChild, "render", render)
    assert run("render", project, "-o", tmp_path / "lit").code == 0
    assert len(lost) == 3
    # Lost three times: the frames of that drawing are reported, the other is made.
    again = run("render", project, "-o", tmp_path / "lit", "--again")
    assert again.code == 1
    assert "Failed: walk.0001.png, walk.0003.png" in again.err
    assert len(lost) == 7


def test_memory_does_not_grow_with_the_frames(
    run: Run, tmp_path: Path, unrendered: list[str]
) -> None:
    """500 frames of 250 drawings; a picture is 150 KiB, so that keeping them would show."""
    project, frames = walk(tmp_path, [n % 250 for n in range(500)]), 500
    held: list[int] = []
    original = Pipeline.light

    def light(self: Pipeline, *given: object, **named: object) -> object:
        held.append(tracemalloc.get_traced_memory()[0])
        return original(self, *given, **named)  # type: ignore[arg-type]

    tracemalloc.start()
    try:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(Pipeline, "light", light)
            assert run("render", project, "-o", tmp_path / "lit").code == 0
    finally:
        tracemalloc.stop()
    assert len(files(tmp_path / "lit")) == frames
    assert len(held) == 250
    assert np.mean(held[-20:]) - np.mean(held[20:40]) < 1 << 20


def test_a_project_gives_its_colours_and_a_scene_to_start_from(run: Run, tmp_path: Path) -> None:
    project, target = walk(tmp_path, [1, 2, 1]), tmp_path / "scene.json"
    assert run("scene", project, "-o", target).code == 0
    scene = decode_scene(target.read_bytes())
    assert (scene.canvas.width, scene.canvas.height) == (96, 96)
    assert {"#645a01", "#8c5a02"} <= set(scene.materials)
    listed = json.loads(run("palette", project, "--json").out)
    pixels = {row["colour"]: row["pixels"] for row in listed}
    assert pixels["#645a01"] == 2 * pixels["#8c5a02"]
