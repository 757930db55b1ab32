"""Render All Frames, in the real Pencil2D: the lit layer is in the project, all else as before."""

from __future__ import annotations

import io
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from lampblack.scene import Floor, LightKey, default_scene, encode_scene
from support.command_line import Run
from support.lamp import SIZE, keep, light_up, project_in, sidecar
from support.window import Display, Pencil2D, SharedPencil2D, pencil2d, wait_until

LAST = 6
"""End of the loop. The example has key frames at 1, 3 and 5, the first two alike."""


def keys(project: Path, layer: str) -> dict[int, NDArray[np.uint8]]:
    """Key frames of a saved layer, each (H, W, 4) uint8 as it lies on the canvas."""
    canvases = {}
    with zipfile.ZipFile(project) as archive:
        tree = ElementTree.fromstring(archive.read("main.xml"))
        (found,) = (each for each in tree.iter("layer") if each.get("name") == layer)
        for image in found.iter("image"):
            canvas = Image.new("RGBA", SIZE)
            name = "data/" + image.attrib["src"]
            if name in archive.namelist():
                left, top = (int(image.attrib[f"topLeft{axis}"]) for axis in "XY")
                with Image.open(io.BytesIO(archive.read(name))) as picture:
                    canvas.paste(picture.convert("RGBA"), (left + SIZE[0] // 2, top + SIZE[1] // 2))
            canvases[int(image.attrib["frame"])] = np.asarray(canvas)
    return canvases


def layer_names(project: Path) -> list[str | None]:
    """Bottom first; none while the project is being saved."""
    try:
        with zipfile.ZipFile(project) as archive:
            tree = ElementTree.fromstring(archive.read("main.xml"))
    except zipfile.BadZipFile:
        return []
    return [layer.get("name") for layer in tree.iter("layer")]


def looped_project_in(folder: Path) -> Path:
    """The example, its loop shortened."""
    project, example = folder / "walk.pclx", folder / "example"
    example.mkdir()
    with zipfile.ZipFile(project_in(example)) as source, zipfile.ZipFile(project, "w") as target:
        for name in source.namelist():
            content = source.read(name)
            if name == "main.xml":
                content = content.replace(
                    b'markOutFrame value="16"', b'markOutFrame value="%d"' % LAST
                )
            target.writestr(name, content)
    return project


def render(window: Pencil2D) -> None:
    window.trigger("lampblack.render")
    wait_until(lambda: not window.value("lampblack.render", "enabled"), "the job to begin")
    wait_until(lambda: window.value("lampblack.render", "enabled"), "the job to end", 400)


def assert_rendered_alike(run: Run, project: Path, folder: Path, last: int) -> None:
    """``lampblack render`` writes the files that the window wrote, to the last byte."""
    options = ("--layers", "lit", "--frames", f"1-{last}")
    assert run("render", project, "-o", folder / "command line", *options).code == 0
    for number in range(1, last + 1):
        name = f"walk.{number:04d}.png"
        mine, theirs = (folder / made / name for made in ("walk_lit", "command line"))
        assert mine.read_bytes() == theirs.read_bytes(), name


def premultiplied(picture: NDArray[np.uint8]) -> NDArray[np.float64]:
    return picture[..., :3] * (picture[..., 3:] / 255.0)


def test_lit_layer_is_in_the_saved_project(shared: SharedPencil2D, tmp_path: Path) -> None:
    project = looped_project_in(tmp_path)
    untouched = project.read_bytes()
    drawn = keys(project, "Lamplighter")
    window = shared.open(project)
    window.set("lampblack.panel.range", "currentIndex", 1)
    window.set("lampblack.panel.hide", "checked", True)
    light_up(window)
    render(window)
    keep(window, "lit layer")
    assert project.read_bytes() == untouched
    assert project.with_name("walk.backup.pclx").read_bytes() == untouched
    window.trigger("actionSave")
    wait_until(lambda: layer_names(project)[-1:] == ["Lit"], "the saved layer")
    wait_until(lambda: sidecar(project).exists(), "the scene")
    window.set("lampblack.panel.range", "currentIndex", 0)
    window.set("lampblack.panel.hide", "checked", False)
    assert layer_names(project) == ["Camera", "Lamplighter", "Lit"]
    lit = keys(project, "Lit")
    assert sorted(lit) == [1, 5, LAST + 1]
    assert not lit[LAST + 1].any(), "blank after the loop"
    for frame in (1, 5):
        with Image.open(tmp_path / "walk_lit" / f"walk.{frame:04d}.png") as picture:
            made = np.asarray(picture.convert("RGBA"))
        assert np.array_equal(lit[frame][..., 3], made[..., 3])
        assert np.abs(premultiplied(lit[frame]) - premultiplied(made)).max() <= 2
    now = keys(project, "Lamplighter")
    assert all(np.array_equal(now[frame], drawn[frame]) for frame in drawn)


def test_frames_taken_apart_are_layers_that_show_the_lit_frame(
    shared: SharedPencil2D, tmp_path: Path
) -> None:
    project = looped_project_in(tmp_path)
    scene = default_scene(*SIZE)
    sidecar(project).write_bytes(encode_scene(replace(scene, floor=Floor(690))))
    shared.close()  # the floor is read with the project
    window = shared.open(project)
    window.set("lampblack.panel.range", "currentIndex", 2)
    window.set("lampblack.panel.apart", "currentIndex", 1)
    light_up(window)
    render(window)
    keep(window, "layers apart")
    window.trigger("actionSave")
    apart = [f"Lit: {name}" for name in ("drawing", "floor shadow", "shade", "light")]
    wait_until(lambda: layer_names(project) == ["Camera", "Lamplighter", *apart], "saved layers")
    window.set("lampblack.panel.range", "currentIndex", 0)
    window.set("lampblack.panel.apart", "currentIndex", 0)
    shown = Image.new("RGBA", SIZE, "white")
    for name in apart:
        shown.alpha_composite(Image.fromarray(keys(project, name)[1]))
    with Image.open(tmp_path / "walk_lit" / "walk.0001.png") as picture:
        lit = Image.new("RGBA", SIZE, "white")
        lit.alpha_composite(picture.convert("RGBA"))
    away = np.abs(np.asarray(shown).astype(int) - np.asarray(lit))
    # Pencil2D keeps colours premultiplied, in bytes.
    assert away.max() <= 2 * len(apart)
    assert away.mean() < 0.2


def test_a_moving_camera_and_keyed_lights_are_rendered_as_on_the_command_line(
    shared: SharedPencil2D, tmp_path: Path, run: Run
) -> None:
    project = looped_project_in(tmp_path)
    still = b'<camera frame="1" r="0" s="1" dx="0" dy="0" />'
    moved = still + b'<camera frame="5" r="8" s="1.25" dx="24" dy="-10" />'
    with zipfile.ZipFile(project) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    assert still in files["main.xml"]
    files["main.xml"] = files["main.xml"].replace(still, moved)
    with zipfile.ZipFile(project, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    scene = default_scene(*SIZE)
    light = scene.lights[0]
    keys = tuple(LightKey(n, x, 200, light.z, light.size) for n, x in ((1, 60), (5, 580)))
    lights = (replace(light, keys=keys), replace(light, x=320.0, colour="#80a0ff", power=0.5))
    sidecar(project).write_bytes(encode_scene(replace(scene, lights=lights)))
    shared.close()  # only what is as in its file is rendered from the file: begin afresh
    window = shared.open(project)
    window.set("lampblack.panel.range", "currentIndex", 1)
    light_up(window)
    render(window)
    keep(window, "moving camera")
    window.set("lampblack.panel.range", "currentIndex", 0)
    assert_rendered_alike(run, project, tmp_path, LAST)


def test_closing_asks_for_the_layer(display: Display, tmp_path: Path) -> None:
    project = project_in(tmp_path)
    with pencil2d(display, tmp_path / "window", project) as window:
        window.set("lampblack.panel.range", "currentIndex", 2)
        light_up(window)
        render(window)
        window.trigger("actionExit")
        wait_until(lambda: window.of_class("QMessageBox"), "a question")
        keep(window, "unsaved layer")
        window.key("Return")
        assert window.process.wait(30) == 0
    assert sorted(keys(project, "Lit")) == [1, 2]
    assert sidecar(project).exists()
