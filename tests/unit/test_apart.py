"""Pictures taken apart: what the layers show together, in the arithmetic of paint programs."""

from __future__ import annotations

import io
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import OpenEXR
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageChops

from lampblack.colour import linear
from lampblack.composite import composite
from lampblack.composite.apart import (
    LAYERS,
    Layer,
    Stages,
    apart_bytes,
    apart_linear,
    byte_stages,
    float_stages,
)
from lampblack.composite.edges import edge_distance
from lampblack.drawing import save_picture
from lampblack.drawing.drawing import Drawing
from lampblack.errors import LampblackError
from lampblack.finals.exr import save_exr
from lampblack.finals.layers import scene_linear
from lampblack.finals.ora import ora_stamp, save_ora
from lampblack.finals.targets import Targets
from lampblack.project import read_project
from lampblack.project.shot import ProjectShot
from lampblack.render.passes import LightPasses, Passes
from lampblack.scene import Ambient, AreaLight, Canvas, Floor, Look, Material, Rim, Scene
from support.command_line import Run, files
from support.drawings import draw_ball, draw_capsule
from unit.test_composite import BACKGROUNDS, RED, make_drawing

Pixels = NDArray[np.uint8]
GROUNDS = [(*background, art) for background in BACKGROUNDS for art in ("painted", "line")]
SHADOWS = [None, (0.4, 0.5, 0.7), (0.3, 0.3, 0.3)]
SIZE = 24, 40
PICTURES = pytest.mark.parametrize("ground", GROUNDS)
SHADED = pytest.mark.parametrize("shadow", SHADOWS)
COLOURS = pytest.mark.parametrize("colour", ["#ffffff", "#ff8040"])


def drawn(ground: tuple[int, int, int, int, str]) -> Drawing:
    *background, art = ground
    drawing = make_drawing(tuple(background))  # type: ignore[arg-type]
    if art == "painted" or background[3]:
        return drawing
    pixels = drawing.pixels.copy()
    pixels[..., 3] = np.rint(255 * drawing.ink * drawing.coverage)
    pixels[..., :3] = 26
    return replace(drawing, pixels=pixels, albedo=np.ones_like(drawing.albedo))


def lit(shadow: tuple[float, float, float] | None, colour: str = "#ffffff") -> tuple[Passes, Scene]:
    """From dark to thrice the light from left to right, with gloss on the red half and a shadow on
    the lower part of the floor."""
    ramp = np.linspace(0, 3, SIZE[1], dtype=np.float32)[None, :, None] * np.ones((*SIZE, 3), "f4")
    shine = np.random.default_rng(1).uniform(0, 0.6, (*SIZE, 1)).astype(np.float32) * ramp
    light = LightPasses(ramp, shine)
    if shadow is not None:
        free = np.full((*SIZE, 3), 0.7, np.float32)
        cast = np.where(np.arange(SIZE[0])[:, None, None] > 14, np.array(shadow, np.float32), 1)
        light = replace(light, floor=free * cast.astype(np.float32), open_floor=free)
    around = LightPasses(np.ones((1, 1, 3), np.float32), np.zeros((1, 1, 3), np.float32))
    scene = Scene(
        Canvas(SIZE[1], SIZE[0]),
        lights=(AreaLight(20, 12, 20, colour=colour),),
        ambient=Ambient(strength=0.1),
        materials={RED: Material(glossy=True)},
        floor=None if shadow is None else Floor(20),
    )
    return Passes((light,), around), scene


def stack(layers: list[Layer], leave: str = "") -> Pixels:
    """The layers over one another: premultiplied, each rounded to bytes, but for one left out."""
    below = np.zeros((*layers[0][2].shape[:2], 4))
    for name, blend, layer in layers:
        if name == leave:
            continue
        alpha, kept = layer[..., 3:] / 255, below[..., 3:]
        source = layer[..., :3] / 255
        ground = np.divide(below[..., :3], kept, out=np.zeros_like(source), where=kept > 0)
        both = {
            "normal": source,
            "multiply": source * ground,
            "add": np.minimum(1, source + ground),
        }[blend]
        colour = alpha * (1 - kept) * source + (1 - alpha) * below[..., :3] + alpha * kept * both
        whole = alpha + kept - alpha * kept
        straight = np.divide(colour, whole, out=np.zeros_like(colour), where=whole > 0)
        straight, whole = np.rint(straight * 255) / 255, np.rint(whole * 255) / 255
        below = np.concatenate([straight * whole, whole], axis=2)
    colour, whole = below[..., :3], below[..., 3:]
    colour = np.divide(colour, whole, out=np.zeros_like(colour), where=whole > 0)
    return np.rint(np.dstack([colour, whole]) * 255).astype(np.uint8)


def difference(a: Pixels, b: Pixels) -> float:
    """The largest difference that can be seen over black, grey or white, in levels."""

    def over(picture: Pixels, ground: float) -> NDArray[np.float64]:
        alpha = picture[..., 3:] / 255
        return np.asarray(picture[..., :3] * alpha + (1 - alpha) * ground)

    return max(float(abs(over(a, g) - over(b, g)).max()) for g in (0, 128, 255))


@PICTURES
@SHADED
@COLOURS
@pytest.mark.parametrize("blended", [True, False])
def test_layers_over_one_another_are_the_lit_picture(
    ground: tuple[int, int, int, int, str],
    shadow: tuple[float, float, float] | None,
    colour: str,
    blended: bool,
) -> None:
    drawing, (passes, scene) = drawn(ground), lit(shadow, colour)
    stages = byte_stages(drawing, passes, scene)
    baked = composite(drawing, passes, scene)
    assert np.array_equal(stages.lit[-1], baked)
    layers = apart_bytes(stages, blended=blended)
    assert [name for name, _, _ in layers] == [name for name, _ in LAYERS]
    shown = stack(layers)
    assert difference(shown, baked) <= 1
    assert abs(shown[..., 3].astype(int) - baked[..., 3]).max() <= 1
    solid = (drawing.pixels[..., 3] == 255) & (baked[..., 3] == 255)
    assert abs(shown.astype(int) - baked)[solid].max(initial=0) <= 1
    # The drawing is as drawn, but for translucent pixels.
    base = layers[0][2]
    assert np.array_equal(base[solid], drawing.pixels[solid])
    empty = (drawing.pixels[..., 3] == 0) & (drawing.coverage == 0)
    assert not base[empty][:, 3].any()


@PICTURES
@SHADED
def test_layers_of_an_exr_are_the_lit_picture(
    tmp_path: Path,
    ground: tuple[int, int, int, int, str],
    shadow: tuple[float, float, float] | None,
) -> None:
    drawing, (passes, scene) = drawn(ground), lit(shadow, "#ff8040")
    stages = float_stages(drawing, passes, scene)
    baked = scene_linear(stages.lit[-1])
    save_exr(tmp_path / "a.exr", {"": baked, **apart_linear(stages, scene_linear)}, "stamp")
    with OpenEXR.File(str(tmp_path / "a.exr"), separate_channels=True) as file:
        read = {name: channel.pixels for name, channel in file.channels().items()}

    def colour(name: str) -> NDArray[np.float32]:
        return np.dstack([read[f"{name}.{letter}"] for letter in "RGB"]).astype(np.float32)

    shown = colour("drawing") * colour("floor_shadow") * colour("shade")
    for name, _ in LAYERS[3:]:
        shown += colour(name)
    near = linear(np.float32([0.5, 0.5 + 1 / 255]))
    assert abs(shown - baked[..., :3]).max() < near[1] - near[0]


def test_each_layer_has_what_its_name_says() -> None:
    drawing, (passes, scene) = drawn((255, 255, 255, 255, "painted")), lit((0.3, 0.3, 0.3))
    layers = {name: layer for name, _, layer in apart_bytes(byte_stages(drawing, passes, scene))}
    inside = drawing.coverage == 1
    left = np.broadcast_to(np.arange(SIZE[1]) < 11, SIZE)
    assert not layers["floor_shadow"][inside][:, 3].any()
    assert layers["floor_shadow"][20, 5, 3] > 0
    assert not layers["light"][left].any()
    assert layers["shade"][inside & left & (drawing.ink == 0)][:, 3].all()
    blue = drawing.labels == 1
    assert not layers["highlight"][blue & inside].any()
    dull = replace(scene, materials={})
    without = stack(apart_bytes(byte_stages(drawing, passes, scene)), leave="highlight")
    assert difference(without, composite(drawing, passes, dull)) <= 1


@pytest.mark.parametrize("ground", GROUNDS)
def test_tones_and_a_rim_are_taken_apart_too(ground: tuple[int, int, int, int, str]) -> None:
    drawing, (passes, scene) = drawn(ground), lit((0.4, 0.5, 0.7), "#ff8040")
    look = Look(tones=(0.4, 0.7), shade_strength=0.6, ink_light=0.5, contact=0.5)
    scene = replace(scene, look=look, rim=Rim(width=4, colour="#80c0ff", away=0))
    edges = edge_distance(drawing.mask, drawing.ink)
    stages = byte_stages(drawing, passes, scene, edges)
    baked = composite(drawing, passes, scene, edges=edges)
    layers = apart_bytes(stages)
    assert difference(stack(layers), baked) <= 1
    if ground[3] == 255:
        rim = {name: layer for name, _, layer in layers}["rim"]
        assert rim[..., 3].any()
        without = composite(drawing, passes, replace(scene, rim=None), edges=edges)
        assert difference(stack(layers, leave="rim"), without) <= 1


def test_layers_are_right_in_pillow() -> None:
    drawing, (passes, scene) = drawn((250, 235, 200, 255, "painted")), lit((0.4, 0.5, 0.7))
    stages = byte_stages(drawing, passes, scene)
    shown = Image.new("RGB", SIZE[::-1])
    for _, blend, layer in apart_bytes(stages):
        source = Image.fromarray(layer)
        colour, alpha = source.convert("RGB"), source.getchannel("A")
        mixed = {
            "normal": lambda a, b: b,
            "multiply": ImageChops.multiply,
            "add": ImageChops.add,
        }[blend](shown, colour)
        shown = Image.composite(mixed, shown, alpha)
    assert abs(np.asarray(shown).astype(int) - stages.lit[-1][..., :3]).max() <= 1


def test_an_openraster_file_is_as_its_specification_says(tmp_path: Path) -> None:
    drawing, (passes, scene) = drawn((0, 0, 0, 0, "painted")), lit((0.3, 0.3, 0.3))
    stages = byte_stages(drawing, passes, scene)
    layers = apart_bytes(stages)
    path = tmp_path / "a.ora"
    save_ora(path, layers, stages.lit[-1], "stamp")
    assert ora_stamp(path) == "stamp"
    assert path.read_bytes()[30:54] == b"mimetypeimage/openraster"
    with zipfile.ZipFile(path) as archive:

        def picture(name: str) -> NDArray[np.uint8]:
            return np.asarray(Image.open(io.BytesIO(archive.read(name))))

        assert archive.infolist()[0].compress_type == zipfile.ZIP_STORED
        merged = picture("mergedimage.png")
        thumbnail = picture("Thumbnails/thumbnail.png")
        image = ElementTree.fromstring(archive.read("stack.xml"))
        found = []
        for element in image.findall("stack/layer"):
            part = picture(element.attrib["src"])
            whole = np.zeros((*SIZE, 4), np.uint8)
            left, top = int(element.attrib["x"]), int(element.attrib["y"])
            whole[top : top + part.shape[0], left : left + part.shape[1]] = part
            found.insert(0, whole)
    assert (image.get("w"), image.get("h")) == ("40", "24")
    operators = [element.attrib["composite-op"] for element in image.findall("stack/layer")]
    assert operators[-3:] == ["svg:multiply", "svg:multiply", "svg:src-over"]
    assert set(operators[:-3]) == {"svg:plus"}
    assert np.array_equal(merged, stages.lit[-1])
    assert max(thumbnail.shape) <= 256
    for ours, (_, _, layer) in zip(found, layers, strict=True):
        assert np.array_equal(ours, layer)
    # What a reader of such files shows is the baked picture.
    named = [element.attrib["name"] for element in image.findall("stack/layer")]
    shot = ProjectShot(*read_project(path), dict.fromkeys(named, "character"))
    assert difference(shot.cel(shot.frames[0]).pixels, stages.lit[-1]) <= 1.5
    path.write_bytes(path.read_bytes()[:-40])
    assert ora_stamp(path) is None
    assert ora_stamp(tmp_path / "none.ora") is None


@pytest.fixture
def halved(monkeypatch: pytest.MonkeyPatch, unrendered: list[str]) -> list[str]:
    """Frames are lit with half their colours, and recorded."""

    def stages(drawing: Drawing, *given: object) -> Stages:
        dark = drawing.pixels // np.array([2, 2, 2, 1], np.uint8)
        return replace(Stages.unlit(dark), drawn=drawing.pixels, floor=drawing.pixels)

    monkeypatch.setattr("lampblack.finals.frame_files.byte_stages", stages)
    return unrendered


def test_every_frame_gets_its_layers_and_only_what_is_missing_again(
    run: Run, tmp_path: Path, halved: list[str]
) -> None:
    for number in (1, 2, 3):
        save_picture(tmp_path / f"a.{number:04d}.png", draw_ball(64 + 8 * (number == 3), canvas=96))
    save_picture(tmp_path / "a.0004.png", np.zeros((96, 96, 4), np.uint8))
    words = ("render", tmp_path / "a.%04d.png", "-o", tmp_path / "lit" / "b.%04d.png")
    assert run(*words, "--allow-blank").code == 0
    baked = (tmp_path / "lit" / "b.0001.png").read_bytes()
    assert run(*words, "--apart", "png", "--allow-blank").code == 0
    names = {f"b.{number:04d}.png" for number in (1, 2, 3, 4)}
    for name, _ in LAYERS:
        assert files(tmp_path / "lit" / name) == names
    layers = {
        name: np.asarray(Image.open(tmp_path / "lit" / name / "b.0001.png")) for name, _ in LAYERS
    }
    assert layers["shade"][48, 48, 3] == pytest.approx(128, abs=1)
    assert layers["shade"][48, 48, :3].max() <= 1
    rendered = len(halved)
    assert run(*words, "--apart", "png", "--allow-blank").code == 0
    assert len(halved) == rendered
    (tmp_path / "lit" / "shade" / "b.0003.png").unlink()
    assert run(*words, "--apart", "png", "--allow-blank").code == 0
    assert len(halved) == rendered + 1
    assert (tmp_path / "lit" / "shade" / "b.0003.png").exists()
    # Other layers beside the same frames.
    assert run(*words, "--apart", "ora", "--allow-blank").code == 0
    assert {f"b.{n:04d}.ora" for n in (1, 2, 3, 4)} < files(tmp_path / "lit")
    assert baked != (tmp_path / "lit" / "b.0001.png").read_bytes()


def test_kinds_of_layers_that_do_not_fit_are_told(tmp_path: Path) -> None:
    with pytest.raises(LampblackError, match="--apart exr"):
        Targets(str(tmp_path / "a.%04d.png"), apart="exr")
    with pytest.raises(LampblackError, match="--apart ora"):
        Targets(str(tmp_path / "a.%04d.exr"), apart="ora")
    assert Targets(str(tmp_path / "lit"), apart="exr").kind == "exr"


def test_layers_do_not_replace_an_input(run: Run, tmp_path: Path, halved: list[str]) -> None:
    (tmp_path / "shade").mkdir()
    for number in (1, 2):
        save_picture(
            tmp_path / "shade" / f"a.{number:04d}.png",
            draw_capsule((64, 64), (20, 20), (40, 40), 9),
        )
    pattern = tmp_path / "shade" / "a.%04d.png"
    told = run("render", pattern, "-o", tmp_path / "a.%04d.png", "--apart", "png")
    assert told.code == 1
    assert "one of the inputs" in told.err
    assert not halved
