"""Render All Frames, in the real Pencil2D: the lit layer is in the project, all else as before."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from support.lamp import SIZE, keep, light_up, project_in, sidecar
from support.window import Display, Pencil2D, pencil2d, wait_until

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
    """Bottom first."""
    with zipfile.ZipFile(project) as archive:
        tree = ElementTree.fromstring(archive.read("main.xml"))
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


def premultiplied(picture: NDArray[np.uint8]) -> NDArray[np.float64]:
    return picture[..., :3] * (picture[..., 3:] / 255.0)


def test_lit_layer_is_in_the_saved_project(display: Display, tmp_path: Path) -> None:
    project = looped_project_in(tmp_path)
    untouched = project.read_bytes()
    drawn = keys(project, "Lamplighter")
    with pencil2d(display, tmp_path / "window", project) as window:
        window.set("lampblack.panel.range", "currentIndex", 1)
        window.set("lampblack.panel.hide", "checked", True)
        light_up(window)
        render(window)
        keep(window, "lit layer")
        assert project.read_bytes() == untouched
        assert project.with_name("walk.backup.pclx").read_bytes() == untouched
        window.trigger("actionSave")
        wait_until(lambda: layer_names(project)[-1] == "Lit", "the saved layer")
        wait_until(lambda: sidecar(project).exists(), "the scene")
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
