"""Pencil2D projects written for tests, and the real Pencil2D's export of them."""

from __future__ import annotations

import io
import os
import shutil
import subprocess
import tempfile
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from lampblack.choices import LayerRole
from lampblack.drawing import load_picture
from lampblack.project import read_project
from lampblack.project.shot import ProjectShot
from support.drawings import draw_ball

Picture = NDArray[np.uint8]

needs_pencil2d = pytest.mark.skipif(
    shutil.which("pencil2d") is None, reason="pencil2d is not installed"
)

STILL = '<camera frame="1" r="0" s="1" dx="0" dy="0"/>'
PALETTE = (
    "<!DOCTYPE PencilPalette><palette>"
    '<Colour red="200" green="20" blue="30" alpha="255" name="Red"/></palette>'
)
ARCH = """<!DOCTYPE PencilVectorImage><image type="vector">
 <curve width="6" variableWidth="0" feather="0" invisible="0" filled="0" colourNumber="0"
  originX="-30" originY="-30" originPressure="1">
  <segment c1x="-10" c1y="-40" c2x="10" c2y="-40" vx="30" vy="-30" pressure="1"/>
  <segment c1x="40" c1y="-10" c2x="40" c2y="10" vx="30" vy="30" pressure="1"/>
 </curve></image>"""


def layer(
    number: int, name: str, images: Sequence[str], *, kind: int = 1, visible: bool = True
) -> str:
    """A layer of keyframes, each the attributes of its element."""
    keys = "".join(f"<image {image}/>" for image in images)
    return (
        f'<layer id="{number}" type="{kind}" name="{name}" visibility="{int(visible)}">'
        f"{keys}</layer>"
    )


def image(frame: int, source: str, left: int = 0, top: int = 0, opacity: float = 1) -> str:
    return f'frame="{frame}" src="{source}" topLeftX="{left}" topLeftY="{top}" opacity="{opacity}"'


def document(
    layers: Sequence[str],
    *,
    camera: str = STILL,
    size: tuple[int, int] = (200, 160),
    version: str = "0.6.6",
) -> str:
    """The XML of a project, whose first layer above the camera is the one that is drawn on."""
    path = "" if version.startswith("0.6") else ' showPath="1"'
    return (
        "<!DOCTYPE PencilDocument><document><projectdata>"
        f'<currentLayer value="{min(1, len(layers))}"/>'
        '<fps value="12"/><isRangedPlayback value="false"/><markOutFrame value="99"/>'
        '</projectdata><object><layer id="1" type="5" name="Camera" visibility="1" '
        f'width="{size[0]}" height="{size[1]}"{path}>{camera}</layer>{"".join(layers)}</object>'
        f"<version>{version}</version></document>"
    )


def png(picture: Picture) -> bytes:
    file = io.BytesIO()
    Image.fromarray(picture).save(file, "PNG")
    return file.getvalue()


def write_project(path: Path, xml: str | bytes, files: Mapping[str, bytes] | None = None) -> Path:
    """A ``.pclx``, or a ``.pcl`` with its folder; ``files`` go to the data folder."""
    if path.suffix == ".pcl":
        path.write_text(str(xml))
        data = path.with_name(path.name + ".data")
        data.mkdir()
        for name, content in (files or {}).items():
            (data / name).write_bytes(content)
        return path
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("main.xml", xml)
        for name, content in (files or {}).items():
            archive.writestr(f"data/{name}", content)
    return path


def walk(folder: Path, cycle: list[int]) -> Path:
    """A project of balls, one key a frame, that repeats drawings as ``cycle`` says."""
    keys = [image(n, f"{name}.png", -40, -40) for n, name in enumerate(cycle, start=1)]
    pictures = {
        f"{n}.png": png(draw_ball(80, ((60 + 40 * n) % 256, 90, n % 200))) for n in set(cycle)
    }
    xml = document([layer(2, "ball", keys)], size=(96, 96))
    return write_project(folder / "walk.pclx", xml, pictures)


def installed_version() -> str:
    """What the installed Pencil2D calls itself: 0.6.6, or Debian's 0.7.0 0.0.0.0."""
    ran = subprocess.run(
        ["pencil2d", "--version"],
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
        check=True, capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    return ran.stdout.split()[-1]


def exported(project: Path, first: int, last: int) -> list[Picture]:
    """Frames as the real Pencil2D exports them."""
    with tempfile.TemporaryDirectory() as home:
        own = dict.fromkeys(("HOME", "TMPDIR", "XDG_RUNTIME_DIR"), home)
        command = ["pencil2d", project, "-o", f"{home}/frame.png", "--transparency"]
        subprocess.run(
            [*command, "--start", str(first), "--end", str(last)],
            env={**os.environ, **own, "QT_QPA_PLATFORM": "offscreen"},
            check=True,
            capture_output=True,
            timeout=120,
        )
        return [load_picture(f"{home}/frame{n:04d}.png") for n in range(first, last + 1)]


def blob(width: int, height: int, seed: int, alpha: int = 255) -> Picture:
    """A smooth, opaque or translucent patch."""
    rows, columns = np.mgrid[0:height, 0:width] / 20 + seed
    waves = [np.sin(rows * k + columns) for k in (1, 2, 3)]
    colour = np.stack(waves, axis=2) * 100 + 128
    return np.dstack([colour, np.full((height, width), alpha)]).astype(np.uint8)


def shot_of(path: Path, roles: dict[str, LayerRole] | None = None) -> ProjectShot:
    return ProjectShot(*read_project(path), roles or {})


def unlit(shot: ProjectShot) -> list[Picture]:
    """Every frame with its cel as drawn."""
    return [shot.finish(frame, shot.cel(frame).pixels) for frame in shot.frames]


def difference(a: Picture, b: Picture) -> NDArray[np.float64]:
    """Of premultiplied colours, in levels, for each pixel."""
    one, other = (
        np.dstack([p[..., :3] * (p[..., 3:] / 255.0), p[..., 3].astype(float)]) for p in (a, b)
    )
    worst: NDArray[np.float64] = np.abs(one - other).max(axis=2)
    return worst


PAN = (
    '<camera frame="1" r="0" s="1" dx="0" dy="0"/><camera frame="5" r="0" s="1" dx="-41" dy="18"/>'
)
FILES = {
    "far.png": png(blob(190, 150, 1)),
    "ball.png": png(draw_ball(90)),
    "near.png": png(blob(40, 30, 3, 128)),
    "secret.png": png(blob(40, 30, 4)),
}
LAYERS = [
    layer(2, "far", [image(1, "far.png", -95, -75)]),
    layer(3, "figure", [image(1, "ball.png", -60, -50), image(4, "ball.png", -30, -40)]),
    layer(4, "hidden", [image(1, "secret.png")], visible=False),
    layer(5, "near", [image(2, "near.png", -70, 10), image(5, "near.png", 900, 10)]),
]
BALL = layer(2, "figure", [image(1, "ball.png")])
ROLES: dict[str, LayerRole] = {"figure": "character"}
