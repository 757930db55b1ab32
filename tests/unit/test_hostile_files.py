"""Files that claim to be what they are not: refused in a sentence, before they cost anything."""

from __future__ import annotations

import os
import struct
import zipfile
import zlib
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lampblack.drawing import load_picture, save_picture
from lampblack.errors import DrawingError, LampblackError, ProjectError
from lampblack.finals.exr import exr_stamp, save_exr
from lampblack.finals.ora import ora_stamp, save_ora
from lampblack.finals.png import png_stamp, save_png
from lampblack.finals.resolve import resolve_shot
from lampblack.finals.scene_overrides import read_scene
from lampblack.finals.settings import RenderSettings
from lampblack.looks import find_style
from lampblack.project import read_project
from lampblack.project.document import Key, Layer
from lampblack.project.paint import LayerPainter
from lampblack.project.region import Region
from lampblack.project.vector import VectorPictures
from lampblack.rigs import find_rig
from support.command_line import Run
from support.drawings import draw_ball
from support.memory import little_memory
from support.projects import ARCH, document, image, layer, needs_pencil2d, png, write_project

READERS: list[Callable[[str], object]] = [
    load_picture,
    lambda name: read_project(name),
    lambda name: read_scene(Path(name)),
    find_rig,
    find_style,
    lambda name: first_drawing(name),
]


def first_drawing(name: str) -> object:
    opened = resolve_shot(RenderSettings(inputs=(name,), output="out"))
    return opened.shot.cel(opened.frames[0])


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("kind", ["device", "pipe", "folder", "link to a device", "long name"])
def test_what_is_no_ordinary_file_is_not_read(
    tmp_path: Path, reader: Callable[[str], object], kind: str
) -> None:
    path = tmp_path / "walk.png"
    if kind == "device":
        path = Path("/dev/zero")
    elif kind == "pipe":
        os.mkfifo(path)  # opening it in the ordinary way would wait for ever
    elif kind == "folder":
        path.mkdir()
    elif kind == "link to a device":
        path.symlink_to("/dev/zero")
    else:
        path = tmp_path / ("x" * 300)
    with little_memory(), pytest.raises((LampblackError, OSError)):
        reader(str(path))


def test_names_that_the_system_refuses_end_in_a_sentence(run: Run, tmp_path: Path) -> None:
    long = "x" * 300 + ".png"
    save_picture(tmp_path / "a.png", draw_ball())
    for arguments in ((long, "-o", tmp_path / "out"), (tmp_path / "a.png", "-o", tmp_path / long)):
        failed = run("render", *arguments)
        assert failed.code == 1
        assert "too long" in failed.err


def chunk(kind: bytes, data: bytes = b"") -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def header(width: int, height: int) -> bytes:
    return chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0))


PIXELS = chunk(b"IDAT", zlib.compress(b"\0" * 16000))
SIGNATURE, END = b"\x89PNG\r\n\x1a\n", chunk(b"IEND")


@pytest.mark.parametrize(
    "chunks",
    [
        header(30, 30) + header(16000, 16000) + PIXELS + END,
        header(30, 30) + PIXELS + header(16000, 16000) + END,
        header(30, 30) + END,
        chunk(b"IHDR", b"") + PIXELS + END,
        PIXELS + header(30, 30) + END,
        header(60000, 60000) + PIXELS + END,
        header(30, 30) + PIXELS,
        header(30, 30) + struct.pack(">I", 0x7FFFFFFF) + b"IDAT",
        header(30, 30) + PIXELS[:-1] + b"?" + END,
    ],
    ids=[
        "two headers", "a header after the pixels", "no pixels", "an empty header",
        "pixels before the header", "too large", "no end", "a chunk of 2 GB", "a wrong checksum",
    ],
)  # fmt: skip
def test_a_png_that_is_put_together_wrongly(tmp_path: Path, chunks: bytes) -> None:
    path = tmp_path / "a.png"
    path.write_bytes(SIGNATURE + chunks)
    with little_memory():
        with pytest.raises(DrawingError):
            load_picture(path)
        assert png_stamp(path) is None  # the same, found in the output folder


def zip_of(path: Path, packing: int, data: bytes, name: str = "data/a.png") -> Path:
    """A project whose one picture is packed in some way."""
    xml = document([layer(2, "a", [image(1, "a.png", -30, -30)])])
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("main.xml", xml)
        archive.writestr(name, data, packing)
    return path


@pytest.mark.parametrize("packing", [zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA])
def test_what_cannot_be_unpacked_bit_by_bit_is_not_unpacked(tmp_path: Path, packing: int) -> None:
    path = zip_of(tmp_path / "bomb.pclx", packing, bytes(300 << 20))
    assert path.stat().st_size < 1 << 17
    project, archive = read_project(path)
    with little_memory(), pytest.raises(ProjectError, match="pack it again"):
        archive.read(project.layers[0].keys[0].file)


def test_a_picture_that_unpacks_to_more_than_its_limit(tmp_path: Path) -> None:
    path = zip_of(tmp_path / "bomb.pclx", zipfile.ZIP_DEFLATED, bytes(300 << 20))
    _, archive = read_project(path)
    with little_memory(300 << 20), pytest.raises(ProjectError, match="larger than 128 MiB"):
        archive.read("a.png")


def patched(place: bytes, at: int, new: bytes) -> Callable[[bytes], bytes]:
    """Replaces some bytes, counted from the last ``place`` in the file."""

    def patch(data: bytes) -> bytes:
        start = data.rindex(place) + at
        return data[:start] + new + data[start + len(new) :]

    return patch


DIRECTORY, LOCAL = b"PK\x01\x02", b"PK\x03\x04"


@pytest.mark.parametrize(
    "damage",
    [
        patched(DIRECTORY, 6, struct.pack("<H", 99)),  # needs version 9.9
        patched(DIRECTORY, 10, struct.pack("<H", 12)),  # bzip2, it says
        patched(DIRECTORY, 10, struct.pack("<H", 77)),  # nobody's way to pack
        patched(DIRECTORY, 8, struct.pack("<H", 1)),  # encrypted
        patched(DIRECTORY, 20, struct.pack("<I", 0xFFFFFFF0)),  # longer than the file
        patched(DIRECTORY, 42, struct.pack("<I", 0x7FFFFFFF)),  # elsewhere
        patched(LOCAL, 26, struct.pack("<H", 0xFFFF)),  # a name longer than the file
        patched(LOCAL, 6, struct.pack("<H", 0x800)),  # its name is UTF-8, it says
        patched(LOCAL, 30, b"\xff\xfe"),  # and it is not
        lambda data: data[:-30],
    ],
)
def test_zips_that_are_put_together_wrongly(
    tmp_path: Path, damage: Callable[[bytes], bytes]
) -> None:
    path = zip_of(tmp_path / "a.pclx", zipfile.ZIP_STORED, png(draw_ball(60)), "data/a.png")
    path.write_bytes(damage(path.read_bytes()))
    with suppress(ProjectError):  # and nothing else
        _, archive = read_project(path)
        archive.read("a.png")


@needs_pencil2d
def test_keys_that_share_a_vector_drawing_share_its_copy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    size = 4 << 20
    drawing = ARCH.replace("</image>", " " * size + "</image>").encode()
    keys = [image(n, "a.vec") for n in range(1, 41)]
    path = write_project(
        tmp_path / "a.pclx", document([layer(2, "lines", keys, kind=2)]), {"a.vec": drawing}
    )
    project, archive = read_project(path)
    written: list[int] = []
    pictures = VectorPictures(archive, (100, 80))

    def run(self: Any, program: str, made: Path, output: Path, frames: int) -> None:
        with zipfile.ZipFile(made) as copy:
            written.append(sum(info.file_size for info in copy.infolist()))
            assert frames == copy.read("main.xml").count(b"1.vec") == 40
        raise ProjectError("enough")

    monkeypatch.setattr(VectorPictures, "_run", run)
    lines = project.layers[0]
    with pytest.raises(ProjectError, match="enough"):
        pictures.picture(lines, lines.keys[0], Region(0, 0, 200, 160))
    assert size < written[0] < 2 * size
    monkeypatch.setattr("lampblack.project.vector.MAX_BYTES", size // 2)
    with pytest.raises(ProjectError, match="--background"):
        pictures.picture(lines, lines.keys[0], Region(0, 0, 200, 160))


def saved(folder: Path, kind: str) -> tuple[Path, Callable[[Path], str | None]]:
    """A finished file with the stamp ``now``, and what reads its stamp."""
    path, picture = folder / f"a.{kind}", draw_ball(60)
    if kind == "png":
        save_png(path, picture, "now")
        return path, png_stamp
    if kind == "exr":
        rng = np.random.default_rng(1)
        layers = {"": rng.random((60, 70, 4), np.float32), "depth": np.ones((60, 70, 1), "f4")}
        save_exr(path, layers, "now")
        return path, exr_stamp
    save_ora(path, [("drawing", "normal", picture)], picture, "now")
    return path, ora_stamp


@pytest.mark.parametrize("kind", ["png", "exr", "ora"])
def test_a_finished_file_is_whole_to_the_last_byte(tmp_path: Path, kind: str) -> None:
    path, stamp = saved(tmp_path, kind)
    whole = path.read_bytes()
    assert stamp(path) == "now"
    coarse = range(0, len(whole), max(1, len(whole) // 60))
    for size in {*coarse, *range(len(whole) - 40, len(whole))}:
        path.write_bytes(whole[:size])
        assert stamp(path) is None, size
    path.unlink()
    os.mkfifo(path)
    assert stamp(path) is None


@pytest.mark.parametrize("kind", ["png", "exr"])
def test_a_finished_file_with_one_other_bit_is_made_again(tmp_path: Path, kind: str) -> None:
    path, stamp = saved(tmp_path, kind)
    whole, rng = path.read_bytes(), np.random.default_rng(3)
    places = {*range(0, 700), *rng.integers(0, len(whole), 500).tolist(), len(whole) - 1}
    for place in places:
        data = bytearray(whole)
        data[place] ^= 1 << int(rng.integers(8))
        path.write_bytes(data)
        assert stamp(path) is None, place


def test_a_finished_file_with_layers_that_was_spoilt_is_made_again(tmp_path: Path) -> None:
    """But for bytes that say nothing of its pictures, such as the time of an entry."""
    path, stamp = saved(tmp_path, "ora")
    whole, rng = path.read_bytes(), np.random.default_rng(3)
    with zipfile.ZipFile(path) as archive:
        inside = [
            (info.header_offset + 30 + len(info.filename), info.file_size)
            for info in archive.infolist()
        ]
    for place, size in inside:
        for _ in range(20):
            data = bytearray(whole)
            data[place + int(rng.integers(size))] ^= 1 << int(rng.integers(8))
            path.write_bytes(data)
            assert stamp(path) is None, place
    for _ in range(300):
        data = bytearray(whole)
        for at in rng.integers(0, len(data), 3):
            data[at] = rng.integers(256)
        path.write_bytes(data)
        stamp(path)  # no traceback


def test_a_picture_that_changes_while_its_shot_is_rendered_fails(tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    save_picture(path, draw_ball(60))
    opened = resolve_shot(RenderSettings(inputs=(str(path),), output=str(tmp_path)))
    opened.shot.cel(opened.frames[0])
    save_picture(path, draw_ball(50))
    with pytest.raises(DrawingError, match="was changed"):
        opened.shot.cel(opened.frames[0])


def test_a_project_that_changes_while_it_is_rendered_fails(tmp_path: Path) -> None:
    xml = document([layer(2, "a", [image(1, "a.png", -30, -30)])])
    path = write_project(tmp_path / "walk.pcl", xml, {"a.png": png(draw_ball(60))})
    opened = resolve_shot(RenderSettings(inputs=(str(path),), output=str(tmp_path)))
    opened.shot.cel(opened.frames[0])
    (tmp_path / "walk.pcl.data" / "a.png").write_bytes(png(draw_ball(50)))
    with pytest.raises(ProjectError, match="was changed"):
        opened.shot.cel(opened.frames[0])


def test_work_grows_with_the_keys_of_a_project_and_not_with_its_frames(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """900 layers over 100,000 frames: what they show is worked out once for each key."""
    keys = [image(1, "a.png"), image(50, "a.png"), image(100_000, "a.png")]
    layers = [layer(n + 2, f"l{n}", keys) for n in range(900)]
    path = write_project(tmp_path / "a.pclx", document(layers), {"a.png": png(draw_ball(40))})
    identify, calls = LayerPainter.identity, []

    def counted(self: LayerPainter, drawn: Layer, key: Key) -> bytes:
        calls.append(key.frame)
        return identify(self, drawn, key)

    monkeypatch.setattr(LayerPainter, "identity", counted)
    opened = resolve_shot(
        RenderSettings(inputs=(str(path),), output=str(tmp_path), frames="1,49,50,100000")
    )
    first, before, then, last = (frame.drawing for frame in opened.frames)
    assert first == before == then == last, "the keys show the same"
    assert len(calls) == 3 * 900
