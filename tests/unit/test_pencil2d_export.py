"""Frames of projects, unlit, against those that the installed Pencil2D exports."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lampblack.choices import LayerRole
from support.drawings import draw_ball
from support.projects import (
    ARCH,
    BALL,
    FILES,
    LAYERS,
    PALETTE,
    PAN,
    ROLES,
    STILL,
    blob,
    difference,
    document,
    exported,
    image,
    installed_version,
    layer,
    needs_pencil2d,
    png,
    shot_of,
    unlit,
    write_project,
)


@needs_pencil2d
@pytest.mark.parametrize("roles", [{}, ROLES], ids=["all lit", "one lit"])
@pytest.mark.parametrize("camera", [STILL, PAN], ids=["still", "pan"])
def test_frames_are_those_that_pencil2d_exports(
    tmp_path: Path, camera: str, roles: dict[str, LayerRole]
) -> None:
    path = write_project(tmp_path / "walk.pclx", document(LAYERS, camera=camera), FILES)
    ours, theirs = unlit(shot_of(path, roles)), exported(path, 1, 5)
    assert len(ours) == 5
    for mine, truth in zip(ours, theirs, strict=True):
        assert difference(mine, truth).max() <= 2


@needs_pencil2d
@pytest.mark.parametrize("zoom", [0.04, 0.23, 0.5])
def test_a_far_camera_costs_what_its_picture_does(tmp_path: Path, zoom: float) -> None:
    """The canvas that it sees is painted at the picture's size."""
    side = round(70 / zoom)
    big = np.asarray(Image.fromarray(blob(70, 70, 1)).resize((side, side)))
    layers = [
        layer(2, "far", [image(1, "big.png", -side // 2 - 3, -side // 2)]),
        layer(3, "arch", ['frame="1" src="a.vec"'], kind=2),
    ]
    contents = {"big.png": png(big), "a.vec": ARCH.encode(), "palette.xml": PALETTE.encode()}
    camera = f'<camera frame="1" r="0" s="{zoom}" dx="7" dy="-31"/>'
    path = write_project(tmp_path / "w.pclx", document(layers, camera=camera), contents)
    shot = shot_of(path)
    assert shot.cel(shot.frames[0]).pixels.shape[1] == 200
    off = difference(unlit(shot)[0], exported(path, 1, 1)[0])
    assert off.mean() < 0.6
    assert np.mean(off > 12) < 0.01


@needs_pencil2d
@pytest.mark.parametrize("size", [(200, 160), (203, 161)])
def test_vector_layers_are_drawn_by_pencil2d(tmp_path: Path, size: tuple[int, int]) -> None:
    layers = [
        layer(2, "ball", [image(1, "ball.png", -45, -45)]),
        layer(3, "arch", ['frame="1" src="a.vec"', 'frame="3" src="b.vec"'], kind=2),
    ]
    files = {
        "ball.png": FILES["ball.png"],
        "a.vec": ARCH.encode(),
        "b.vec": ARCH.replace('vx="30"', 'vx="70"').encode(),
        "palette.xml": PALETTE.encode(),
    }
    # By whole pixels: Pencil2D rounds where bitmaps go, but not vectors.
    pan = PAN.replace("-41", "-40").replace("18", "16")
    path = write_project(tmp_path / "v.pclx", document(layers, camera=pan, size=size), files)
    ours = unlit(shot_of(path))
    for mine, truth in zip(ours, exported(path, 1, 5), strict=True):
        assert difference(mine, truth).max() <= 2
    assert difference(ours[0], ours[2]).max() > 100


@needs_pencil2d
def test_opacity_is_that_of_pencil2d(tmp_path: Path) -> None:
    """Of keys of a bitmap and a vector layer over another bitmap."""
    if installed_version().startswith("0.6"):
        pytest.skip("Pencil2D 0.6 has no opacity")
    opacities = (0, 0.1, 0.33, 0.5, 0.75, 1)
    keys = [image(n, "near.png", -20, -15, part) for n, part in enumerate(opacities, start=1)]
    drawn = [f'frame="{n}" src="a.vec" opacity="{o}"' for n, o in enumerate(opacities, start=1)]
    layers = [
        layer(2, "ball", [image(1, "ball.png", -45, -45, 0.8)]),
        layer(3, "near", keys),
        layer(4, "arch", drawn, kind=2),
    ]
    files = {**FILES, "a.vec": ARCH.encode(), "palette.xml": PALETTE.encode()}
    path = write_project(tmp_path / "w.pclx", document(layers, version="0.7.0"), files)
    ours, theirs = unlit(shot_of(path)), exported(path, 1, len(opacities))
    for mine, truth in zip(ours, theirs, strict=True):
        assert difference(mine, truth).max() <= 2
    assert difference(theirs[0], theirs[-1]).max() > 100


INLINE = ARCH[ARCH.index("<curve") : ARCH.index("</image>")]
HABITS = {
    "never drawn": [layer(2, "x", [image(1, "a.png"), image(2, "gone.png"), image(3, "a.png")])],
    "no file named": [layer(2, "x", [image(1, "a.png"), 'frame="2"', image(3, "a.png", 9, 9)])],
    "vector never drawn": [
        layer(2, "x", ['frame="1" src="a.vec"', 'frame="2" src="b.vec"'], kind=2)
    ],
    "vector in the XML": [
        '<layer id="2" type="2" name="v" visibility="1">'
        f'<image frame="1" type="vector">{INLINE}</image><image frame="3" type="vector"/></layer>'
    ],
    "key at 0": [layer(2, "x", [image(0, "a.png", -40, -40), image(2, "a.png", 5, -40)])],
    "key before 0": [layer(2, "x", [image(-3, "a.png", -40, -40), image(3, "a.png", 5, 0)])],
    "two keys at one frame": [layer(2, "x", [image(1, "a.png"), image(1, "a.png", -40, 5)])],
    "JPEG under a PNG's name": [layer(2, "x", [image(1, "jpeg.png", -40, -40)])],
    "sound": [
        layer(2, "x", [image(1, "a.png")]),
        '<layer id="9" type="4" name="s" visibility="1"><sound frame="1" src="x.wav"/></layer>',
    ],
}


@needs_pencil2d
@pytest.mark.parametrize("habit", HABITS)
def test_habits_of_pencil2d_are_shown_as_it_shows_them(tmp_path: Path, habit: str) -> None:
    jpeg = io.BytesIO()
    Image.fromarray(draw_ball(90)[..., :3]).save(jpeg, "JPEG", quality=95)
    contents = {"a.png": FILES["ball.png"], "jpeg.png": jpeg.getvalue(), "a.vec": ARCH.encode()}
    contents["palette.xml"] = PALETTE.encode()
    told = installed_version().removeprefix("v")
    version = told if told.startswith(("0.6", "0.7")) else "0.7.0"
    path = write_project(tmp_path / "w.pclx", document(HABITS[habit], version=version), contents)
    ours, theirs = unlit(shot_of(path)), exported(path, 1, 3)
    for mine, truth in zip(ours, theirs, strict=False):
        assert difference(mine, truth).max() <= (3 if "JPEG" in habit else 2)
    assert theirs[0].any()


@needs_pencil2d
@pytest.mark.parametrize("old", ["no camera", "no document"])
def test_projects_of_early_versions_are_shown_as_pencil2d_shows_them(
    tmp_path: Path, old: str
) -> None:
    xml = document([BALL])
    if old == "no camera":
        start = xml.index('<layer id="1"')
        xml = xml[:start] + xml[xml.index("</layer>") + len("</layer>") :]
    else:
        drawn = xml[xml.index("<object>") : xml.index("</object>")]
        xml = f"<!DOCTYPE PencilDocument>{drawn}</object>"
    path = write_project(tmp_path / "w.pclx", xml, FILES)
    mine, truth = unlit(shot_of(path))[0], exported(path, 1, 1)[0]
    assert mine.shape == truth.shape
    assert difference(mine, truth).max() <= 2


SAVED = Path(__file__).parents[1] / "data" / "pencil2d"


@needs_pencil2d
@pytest.mark.parametrize(
    ("name", "frames"), [("keys", 6), ("cleared-bitmap", 4), ("cleared-vector", 4)]
)
def test_a_project_that_pencil2d_saved_is_shown_as_it_shows_it(name: str, frames: int) -> None:
    """Keys of bitmap and vector layers, made in Pencil2D 0.6.6: doubled, moved and added blank;
    or drawn, and the third one cleared."""
    path = SAVED / f"{name}.pclx"
    ours, theirs = unlit(shot_of(path)), exported(path, 1, frames)
    for mine, truth in zip(ours, theirs, strict=True):
        assert difference(mine, truth).max() <= 2
    drawn = [np.count_nonzero(picture[..., 3]) for picture in theirs]
    assert drawn[4] == 0 if name == "keys" else drawn[2] == min(drawn)
