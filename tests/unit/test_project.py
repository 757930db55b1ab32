"""Projects of Pencil2D: what of them is lit, and what is refused of those that nobody drew."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.errors import LampblackWarning, ProjectError
from lampblack.project import read_project
from lampblack.project.archive import MAX_XML_BYTES
from lampblack.scene import default_scene
from support.command_line import files
from support.drawings import draw_ball
from support.projects import (
    ARCH,
    BALL,
    FILES,
    LAYERS,
    PAN,
    ROLES,
    STILL,
    document,
    image,
    layer,
    png,
    shot_of,
    unlit,
    write_project,
)

Picture = NDArray[np.uint8]


def test_a_frame_that_the_camera_flattens_is_empty(tmp_path: Path) -> None:
    """Matrices of opposite angles meet at zero, halfway."""
    xml = document([BALL], camera='<camera frame="1"/><camera frame="3" r="180"/>')
    frames = unlit(shot_of(write_project(tmp_path / "w.pclx", xml, FILES)))
    assert [bool(frame.any()) for frame in frames] == [True, False, True]


def test_more_canvas_than_can_be_lit_is_lit_smaller(tmp_path: Path) -> None:
    camera = STILL + '<camera frame="4" r="0" s="1" dx="9000" dy="9000"/>'
    path = write_project(tmp_path / "w.pclx", document([BALL], camera=camera), FILES)
    with pytest.warns(LampblackWarning, match="of their size"):
        shot = shot_of(path)
    assert shot.cel(shot.frames[0]).pixels[..., 3].any()
    scene = shot.place(shot.frames[0], default_scene(200, 160), (shot.region.width, 9))
    assert scene.lights[0].z == pytest.approx(100 * shot.region.scale)


def test_without_pencil2d_vector_layers_are_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    layers = [layer(2, "arch", ['frame="1" src="a.vec"'], kind=2)]
    path = write_project(tmp_path / "v.pclx", document(layers), {"a.vec": ARCH.encode()})
    shot = shot_of(path)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(ProjectError, match="'arch'"):
        shot.cel(shot.frames[0])


def test_held_drawings_share_a_name_and_moved_ones_do_not(tmp_path: Path) -> None:
    path = write_project(tmp_path / "walk.pclx", document(LAYERS, camera=PAN), FILES)
    frames = shot_of(path, ROLES).frames
    assert [frame.name for frame in frames[:2]] == ["walk.0001.png", "walk.0002.png"]
    assert len({frame.drawing for frame in frames}) == 2
    assert len({frame.setting for frame in frames}) == 5


def test_a_folder_project_is_the_same_as_a_zipped_one(tmp_path: Path) -> None:
    zipped = write_project(tmp_path / "walk.pclx", document(LAYERS), FILES)
    folder = write_project(tmp_path / "walk.pcl", document(LAYERS), FILES)
    pairs = zip(unlit(shot_of(zipped)), unlit(shot_of(folder)), strict=True)
    assert all(np.array_equal(a, b) for a, b in pairs)


def test_opacity_of_a_keyframe_counts(tmp_path: Path) -> None:
    faint = layer(2, "faint", [image(1, "ball.png", -45, -45, opacity=0.25)])
    path = write_project(tmp_path / "walk.pclx", document([faint]), FILES)
    shot = shot_of(path)
    assert shot.cel(shot.frames[0]).pixels[..., 3].max() == round(255 * 0.25)


@pytest.mark.parametrize(
    ("version", "frames"), [("0.6.6", [1, 2, 3]), ("0.7.0", [1, 3]), ("0.7.2", [1, 2, 3])]
)
def test_a_key_that_names_no_file_is_blank_but_none_in_070(
    tmp_path: Path, version: str, frames: list[int]
) -> None:
    keys = [image(1, "ball.png"), 'frame="2"', image(3, "ball.png")]
    xml = document([layer(2, "ball", keys)], version=version)
    project, _ = read_project(write_project(tmp_path / "w.pclx", xml, FILES))
    assert [key.frame for key in project.layers[0].keys] == frames


def test_roles_say_what_is_lit_and_what_lies_around(tmp_path: Path) -> None:
    line = layer(6, "line", [image(1, "near.png", -70, 10)])
    lit = layer(7, "Lit", [image(1, "secret.png")])
    path = write_project(tmp_path / "walk.pclx", document([*LAYERS, line, lit]), FILES)
    shot = shot_of(path, {"figure": "character", "line": "line"})
    cel = shot.cel(shot.frames[0])
    assert cel.ink is not None
    # "near" lies between figure and line: beneath what is lit, not above it.
    assert shot._stack.below[1].name == "near"
    assert not shot._stack.above
    # The drawing tool's own result is neither lit nor shown.
    assert "Lit" not in [one.name for one in shot_of(path)._stack.lit]


@pytest.mark.parametrize("name", ["Lit", "Lit: shade"])
def test_sources_hidden_behind_their_result_are_lit(tmp_path: Path, name: str) -> None:
    hidden = layer(2, "figure", [image(1, "ball.png", -45, -45)], visible=False)
    result = layer(3, name, [image(1, "secret.png")])
    path = write_project(tmp_path / "walk.pclx", document([hidden, result]), FILES)
    assert shot_of(path, ROLES).cel(shot_of(path, ROLES).frames[0]).pixels.any()
    with pytest.raises(ProjectError, match="visible layers"):
        shot_of(path)
    with pytest.warns(LampblackWarning, match="no layer 'figur'"), pytest.raises(ProjectError):
        shot_of(path, {"figur": "character"})


@pytest.mark.parametrize(
    "source",
    ["../../secret.png", "/etc/passwd", "..", "a/b.png", "C:\\x.png", "..\\x.png", "x" * 300],
)
@pytest.mark.parametrize("suffix", [".pclx", ".pcl"])
def test_names_that_lead_elsewhere_are_refused(tmp_path: Path, source: str, suffix: str) -> None:
    (tmp_path / "secret.png").write_bytes(FILES["secret.png"])
    xml = document([layer(2, "figure", [image(1, source)])])
    path = write_project(tmp_path / f"walk{suffix}", xml, {})
    with pytest.raises(ProjectError, match="outside its own folder"):
        shot_of(path)


def test_links_that_lead_elsewhere_are_refused(tmp_path: Path) -> None:
    (tmp_path / "secret.png").write_bytes(FILES["secret.png"])
    xml = document([layer(2, "figure", [image(1, "link.png")])])
    path = write_project(tmp_path / "walk.pcl", xml, {})
    (tmp_path / "walk.pcl.data" / "link.png").symlink_to(tmp_path / "secret.png")
    shot = shot_of(path)
    with pytest.raises(ProjectError, match="outside its own folder"):
        shot.cel(shot.frames[0])


def test_broken_pictures_are_told_by_their_frame(tmp_path: Path) -> None:
    keys = [image(1, "ball.png"), image(2, "bad.png"), image(3, "big.png")]
    enormous = bytearray(png(draw_ball(32)))
    enormous[16:24] = (100_000).to_bytes(4, "big") * 2
    files = {"ball.png": FILES["ball.png"], "bad.png": b"\x89PNG", "big.png": bytes(enormous)}
    path = write_project(tmp_path / "w.pclx", document([layer(2, "figure", keys)]), files)
    shot = shot_of(path)
    assert shot.cel(shot.frames[0]).pixels.any()
    for frame, words in zip(shot.frames[1:], ("frame 2", "too large"), strict=True):
        with pytest.raises(ProjectError, match=words):
            shot.cel(frame)


def test_a_picture_that_was_lost_is_told(tmp_path: Path) -> None:
    xml = document([layer(2, "figure", [image(1, "ball.png"), image(2, "gone.png", -9, 4)])])
    path = write_project(tmp_path / "w.pclx", xml, FILES)
    with pytest.warns(LampblackWarning, match="frame 2 of 'figure'"):
        assert not unlit(shot_of(path))[1].any()


BOMB = """<!DOCTYPE a [<!ENTITY b "bbbbbbbbbb"><!ENTITY c "&b;&b;&b;&b;">]>
<document><object><layer type="5" width="9" height="9" name="&c;"/></object></document>"""
OUTSIDE = """<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]>
<document><object><layer type="5" width="9" height="9" name="&b;"/></object></document>"""


@pytest.mark.parametrize(
    "xml",
    [
        "",
        "<document",
        "\x00\xff",
        "<document/>",
        "<html><object><layer/></object></html>",
        "<a>" * 100_000,
        BOMB,
        OUTSIDE,
        '<?xml version="1.0" encoding="nonsense"?><document/>',
        document([]).replace('type="5"', 'type="9"'),
        document([BALL], size=(0, 9)),
        document([BALL], size=(1_000_000, 9)),
        document([BALL], size=(16000, 16000)),
        document([BALL.replace('frame="1"', 'frame="1e9"')]),
        document([BALL.replace('frame="1"', 'frame="900000"')]),
        document([BALL.replace('topLeftX="0"', 'topLeftX="nan"')]),
        document([BALL.replace('topLeftX="0"', 'topLeftX="1e300"')]),
        document([BALL.replace('topLeftX="0"', 'topLeftX="0.5"')]),
        document([BALL], camera='<camera frame="1" s="0"/>'),
        document([BALL], camera='<camera frame="1" dx="inf"/>'),
        document([BALL] * 1001),
    ],
)
def test_descriptions_that_make_no_sense_are_told(tmp_path: Path, xml: str) -> None:
    path = write_project(tmp_path / "walk.pclx", xml, FILES)
    with pytest.raises(ProjectError) as told:
        shot_of(path)
    assert told.value.what


def test_files_that_are_no_projects_are_told(tmp_path: Path) -> None:
    sound = write_project(tmp_path / "a.pclx", document([BALL]), FILES).read_bytes()
    huge = io.BytesIO()
    with zipfile.ZipFile(huge, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("main.xml", b" " * (MAX_XML_BYTES + 1))
    damaged = bytearray(sound)
    start = sound.index(b"<!DOCTYPE")
    damaged[start : start + 50] = bytes(50)
    for content in (b"", b"text", sound[: len(sound) // 2], huge.getvalue(), bytes(damaged)):
        path = tmp_path / "bad.pclx"
        path.write_bytes(content)
        with pytest.raises(ProjectError):
            read_project(path)
    nested = tmp_path / "nested.pclx"
    with zipfile.ZipFile(nested, "w") as archive:
        archive.writestr("walk/main.xml", document([BALL]))
    with pytest.raises(ProjectError, match="'walk/'") as told:
        read_project(nested)
    assert "at the top" in told.value.remedy
    for path in (tmp_path / "none.pclx", tmp_path):
        with pytest.raises(ProjectError, match=r"(no|not a) project"):
            read_project(path)


def test_reading_a_project_writes_nothing_beside_it(tmp_path: Path) -> None:
    path = write_project(tmp_path / "walk.pclx", document(LAYERS, camera=PAN), FILES)
    before = path.read_bytes()
    unlit(shot_of(path, ROLES))
    assert files(tmp_path) == {"walk.pclx"}
    assert path.read_bytes() == before


@pytest.mark.filterwarnings("ignore:Duplicate name")
def test_entries_of_one_name_count_each(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("lampblack.project.archive.MAX_ENTRIES", 5)
    path = write_project(tmp_path / "w.pclx", document([BALL]), FILES)
    with zipfile.ZipFile(path, "a") as archive:
        for _ in range(5):
            archive.writestr("data/ball.png", b"")
    with pytest.raises(ProjectError, match="more than 5"):
        read_project(path)
