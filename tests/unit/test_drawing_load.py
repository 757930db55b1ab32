"""Pictures in and out: every format, colour type and depth, and every way a file can be bad."""

from __future__ import annotations

import os
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageCms

from lampblack import colour
from lampblack.drawing import load_picture, save_picture
from lampblack.errors import DrawingError, LampblackError, LampblackWarning

GREY, RGB, INDEXED, GREY_ALPHA, RGB_ALPHA = 0, 2, 3, 4, 6


def chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png(width: int, height: int, depth: int, kind: int, row: bytes, extra: bytes = b"") -> bytes:
    """A PNG with the same ``row`` of packed samples all the way down."""
    header = struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0)
    data = zlib.compress((b"\0" + row) * height)
    chunks = chunk(b"IHDR", header) + extra + chunk(b"IDAT", data) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + chunks


def first_row(tmp_path: Path, data: bytes) -> list[list[int]]:
    path = tmp_path / "picture.png"
    path.write_bytes(data)
    row: list[list[int]] = load_picture(path)[0].tolist()
    return row


def words(*values: int) -> bytes:
    return struct.pack(f">{len(values)}H", *values)


@pytest.mark.parametrize(
    ("depth", "kind", "row", "extra", "expected"),
    [
        (8, GREY, b"\x00\x80\xff", b"", [[0] * 3 + [255], [128] * 3 + [255], [255] * 4]),
        (8, GREY, b"\x07\x09", chunk(b"tRNS", words(7)), [[7] * 3 + [0], [9] * 3 + [255]]),
        (1, GREY, b"\x40", b"", [[0] * 3 + [255], [255] * 4]),
        (1, GREY, b"\x40", chunk(b"tRNS", words(1)), [[0] * 3 + [255], [255] * 3 + [0]]),
        (2, GREY, b"\x1b", chunk(b"tRNS", words(1)), [[0] * 3 + [255], [85] * 3 + [0]]),
        (4, GREY, b"\x1f", chunk(b"tRNS", words(15)), [[17] * 3 + [255], [255] * 3 + [0]]),
        (16, GREY, words(0x8080, 257), b"", [[128] * 3 + [255], [1, 1, 1, 255]]),
        (16, GREY, words(5, 65535), chunk(b"tRNS", words(5)), [[0, 0, 0, 0], [255] * 4]),
        (8, GREY_ALPHA, b"\x09\x40\x80\xff", b"", [[9, 9, 9, 64], [128, 128, 128, 255]]),
        (16, GREY_ALPHA, words(0x0909, 0x4040), b"", [[9, 9, 9, 64]]),
        (8, RGB, b"\x01\x02\x03", b"", [[1, 2, 3, 255]]),
        (8, RGB, b"\x01\x02\x03", chunk(b"tRNS", words(1, 2, 3)), [[1, 2, 3, 0]]),
        (16, RGB, words(0x0101, 0x8080, 0xFFFF), b"", [[1, 128, 255, 255]]),
        (16, RGB, words(257, 0, 0), chunk(b"tRNS", words(257, 0, 0)), [[1, 0, 0, 0]]),
        (8, RGB_ALPHA, b"\x01\x02\x03\x04", b"", [[1, 2, 3, 4]]),
        (16, RGB_ALPHA, words(257, 514, 771, 1028), b"", [[1, 2, 3, 4]]),
        (
            2,
            INDEXED,
            b"\x10",
            chunk(b"PLTE", bytes([1, 2, 3, 4, 5, 6])) + chunk(b"tRNS", b"\x00\x80"),
            [[1, 2, 3, 0], [4, 5, 6, 128]],
        ),
    ],
)
def test_every_kind_of_png(
    tmp_path: Path, depth: int, kind: int, row: bytes, extra: bytes, expected: list[list[int]]
) -> None:
    assert first_row(tmp_path, png(len(expected), 2, depth, kind, row, extra)) == expected


def test_sixteen_bits_come_within_one_level(tmp_path: Path) -> None:
    values = np.arange(0, 65536, 40)
    data = png(len(values), 1, 16, RGB, words(*np.repeat(values, 3).tolist()))
    read = np.array(first_row(tmp_path, data))[:, 0]
    assert np.abs(read - values / 257).max() <= 1


def test_round_trip(tmp_path: Path) -> None:
    picture = np.random.default_rng(0).integers(0, 256, (31, 17, 4)).astype(np.uint8)
    save_picture(tmp_path / "a.png", picture)
    np.testing.assert_array_equal(load_picture(tmp_path / "a.png"), picture)
    assert [path.name for path in tmp_path.iterdir()] == ["a.png"]


@pytest.fixture
def good(tmp_path: Path) -> bytes:
    picture = np.random.default_rng(0).integers(0, 256, (40, 40, 4)).astype(np.uint8)
    save_picture(tmp_path / "good.png", picture)
    return (tmp_path / "good.png").read_bytes()


@pytest.mark.parametrize("share", [0, 0.01, 0.1, 0.5, 0.9, 0.995])
def test_cut_short(tmp_path: Path, good: bytes, share: float) -> None:
    path = tmp_path / "cut.png"
    path.write_bytes(good[: int(share * len(good))])
    with pytest.raises(DrawingError):
        load_picture(path)


def test_corrupt(tmp_path: Path, good: bytes) -> None:
    path = tmp_path / "corrupt.png"
    for place in (18, 29, 50, len(good) // 2):
        data = bytearray(good)
        data[place] ^= 0x55
        path.write_bytes(data)
        with pytest.raises(DrawingError):
            load_picture(path)


def test_not_a_picture(tmp_path: Path) -> None:
    text = tmp_path / "text.png"
    text.write_text("hello, I am a drawing, honestly, and long enough for a header")
    with pytest.raises(DrawingError, match="not a picture"):
        load_picture(text)
    with pytest.raises(DrawingError, match="no picture"):
        load_picture(tmp_path / "missing.png")
    with pytest.raises(DrawingError, match="folder"):
        load_picture(tmp_path)


@pytest.mark.parametrize("size", [(16385, 1), (1, 16385), (10001, 10000), (2**31 - 1, 2**31 - 1)])
def test_absurd_sizes_are_refused_before_decoding(tmp_path: Path, size: tuple[int, int]) -> None:
    path = tmp_path / "huge.png"
    header = struct.pack(">IIBBBBB", *size, 8, RGB_ALPHA, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header))
    with pytest.raises(DrawingError, match="too large"):
        load_picture(path)


def test_large_picture_is_read_without_a_warning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Image, "MAX_IMAGE_PIXELS", 100)
    path = tmp_path / "large.png"
    path.write_bytes(png(96, 96, 1, GREY, b"\xff" * 12))
    assert load_picture(path).shape == (96, 96, 4)


def test_zero_width(tmp_path: Path) -> None:
    path = tmp_path / "zero.png"
    path.write_bytes(png(0, 3, 8, GREY, b""))
    with pytest.raises(DrawingError):
        load_picture(path)


def test_failed_save_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    picture = np.zeros((4, 4, 4), np.uint8)
    with pytest.raises(LampblackError, match=r"none.a\.png"):
        save_picture(tmp_path / "none" / "a.png", picture)

    def full(*_: object, **__: object) -> None:
        raise OSError(28, os.strerror(28))

    monkeypatch.setattr(Image.Image, "save", full)
    with pytest.raises(LampblackError, match="No space left"):
        save_picture(tmp_path / "a.png", picture)

    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Image.Image, "save", interrupted)
    with pytest.raises(KeyboardInterrupt):
        save_picture(tmp_path / "a.png", picture)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("kind", ["JPEG", "WEBP", "TIFF", "TGA", "BMP", "GIF"])
def test_other_formats_are_read_whatever_their_name(tmp_path: Path, kind: str) -> None:
    """All but TGA, which has no signature, are known by their content."""
    path = tmp_path / ("picture.tga" if kind == "TGA" else "picture.png")
    Image.new("RGB", (20, 10), (200, 30, 40)).save(path, kind)
    picture = load_picture(path)
    assert picture.shape == (10, 20, 4)
    assert np.abs(picture.astype(int) - (200, 30, 40, 255)).max() <= 2


@pytest.mark.parametrize("kind", ["JPEG", "WEBP", "TIFF", "TGA", "BMP", "GIF"])
@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_other_formats_cut_short_are_refused(tmp_path: Path, kind: str, share: float) -> None:
    path = tmp_path / "picture.tga"
    noise = np.random.default_rng(0).integers(0, 256, (40, 40, 3)).astype(np.uint8)
    Image.fromarray(noise).save(path, kind)
    path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
    with pytest.raises(DrawingError):
        load_picture(path)


def test_a_large_picture_of_another_format_is_refused_before_decoding(tmp_path: Path) -> None:
    path = tmp_path / "huge.bmp"
    Image.new("L", (4, 4)).save(path, "BMP")
    data = bytearray(path.read_bytes())
    data[18:26] = struct.pack("<ii", 30000, 30000)
    path.write_bytes(data)
    with pytest.raises(DrawingError, match="too large"):
        load_picture(path)


def test_a_picture_is_turned_upright(tmp_path: Path) -> None:
    """Orientation 6: the stored top is the right side."""
    stored = np.zeros((2, 3, 3), np.uint8)
    stored[0, 0] = 255
    exif = Image.Exif()
    exif[0x0112] = 6
    Image.fromarray(stored).save(tmp_path / "turned.png", exif=exif)
    picture = load_picture(tmp_path / "turned.png")
    assert picture.shape == (3, 2, 4)
    assert picture[0, 1, 0] == 255
    assert picture[..., 0].sum() == 255


@pytest.mark.parametrize(("kind", "depth"), [(RGB, 8), (RGB, 16), (GREY, 16)])
def test_the_gamma_of_a_png_is_applied(tmp_path: Path, kind: int, depth: int) -> None:
    """A linear half is 188 in sRGB."""
    sample = words(0x8080) if depth == 16 else b"\x80"
    row = sample * (3 if kind == RGB else 1)
    linear = chunk(b"gAMA", struct.pack(">I", 100_000))
    assert first_row(tmp_path, png(1, 1, depth, kind, row, linear)) == [[188, 188, 188, 255]]
    for extra in (b"", chunk(b"gAMA", struct.pack(">I", 45_455)), linear + chunk(b"sRGB", b"\0")):
        assert first_row(tmp_path, png(1, 1, depth, kind, row, extra))[0][0] == 128


@pytest.mark.parametrize("kind", [GREY, RGB, RGB_ALPHA])
def test_dark_tones_of_linear_light_are_read_in_16_bits(tmp_path: Path, kind: int) -> None:
    """In 8 bits there are 13 levels of sRGB between the two darkest."""
    light = np.arange(0, 2000, 7)
    channels = {GREY: 1, RGB: 3, RGB_ALPHA: 4}[kind]
    row = words(*np.repeat(light, channels).tolist())
    linear = chunk(b"gAMA", struct.pack(">I", 100_000))
    found = np.array(first_row(tmp_path, png(len(light), 1, 16, kind, row, linear)))
    expected = np.rint(colour.srgb(light / 65535) * 255)
    assert np.array_equal(found[:, 0], expected)
    assert np.array_equal(found[:, 2], expected)
    if kind == RGB_ALPHA:
        assert np.array_equal(found[:, 3], (light + 128) // 257)


def test_a_linear_profile_is_read_in_16_bits(tmp_path: Path) -> None:
    red, green, blue = (0.4360, 0.2225, 0.0139), (0.3851, 0.7169, 0.0971), (0.1431, 0.0606, 0.7141)
    curve = b"curv\0\0\0\0" + struct.pack(">IH", 1, 256)
    profile = icc_profile(colorant(*red), colorant(*green), colorant(*blue), curve)
    packed = chunk(b"iCCP", b"p\0\0" + zlib.compress(profile))
    light = np.arange(0, 2000, 7)
    row = words(*np.repeat(light, 3).tolist())
    found = np.array(first_row(tmp_path, png(len(light), 1, 16, RGB, row, packed)))
    assert np.array_equal(found[:, 1], np.rint(colour.srgb(light / 65535) * 255))


def test_a_transparent_colour_of_linear_light_stays_so(tmp_path: Path) -> None:
    extra = chunk(b"gAMA", struct.pack(">I", 100_000)) + chunk(b"tRNS", words(258, 0, 0))
    found = first_row(tmp_path, png(2, 1, 16, RGB, words(258, 0, 0, 257, 0, 0), extra))
    assert [pixel[3] for pixel in found] == [0, 255]


def icc_profile(red: bytes, green: bytes, blue: bytes, curve: bytes) -> bytes:
    """A version 2 monitor profile with these colorants and one tone curve."""
    white = b"XYZ \0\0\0\0" + struct.pack(">3i", 63190, 65536, 54061)
    tags = {
        b"desc": b"desc\0\0\0\0" + struct.pack(">I", 5) + b"test\0" + bytes(79),
        b"wtpt": white, b"rXYZ": red, b"gXYZ": green, b"bXYZ": blue,
        b"rTRC": curve, b"gTRC": curve, b"bTRC": curve,
    }  # fmt: skip
    place, table, body = 128 + 4 + 12 * len(tags), b"", b""
    for name, data in tags.items():
        data += bytes(-len(data) % 4)
        table += name + struct.pack(">II", place + len(body), len(data))
        body += data
    head = struct.pack(
        ">I4sI4s4s4s", place + len(body), b"lcms", 0x02100000, b"mntr", b"RGB ", b"XYZ "
    )
    head += bytes(12) + b"acsp" + bytes(28) + struct.pack(">3i", 63190, 65536, 54061)
    return head + bytes(128 - len(head)) + struct.pack(">I", len(tags)) + table + body


def colorant(*xyz: float) -> bytes:
    return b"XYZ \0\0\0\0" + struct.pack(">3i", *(round(v * 65536) for v in xyz))


def test_an_embedded_profile_is_applied(tmp_path: Path) -> None:
    """Linear light, and red and green change places."""
    red, green, blue = (0.4360, 0.2225, 0.0139), (0.3851, 0.7169, 0.0971), (0.1431, 0.0606, 0.7141)
    curve = b"curv\0\0\0\0" + struct.pack(">IH", 1, 256)
    profile = icc_profile(colorant(*green), colorant(*red), colorant(*blue), curve)
    picture = np.full((1, 1, 4), (128, 0, 255, 77), np.uint8)
    Image.fromarray(picture).save(tmp_path / "p.png", icc_profile=profile)
    assert np.abs(load_picture(tmp_path / "p.png")[0, 0].astype(int) - (0, 188, 255, 77)).max() <= 1


def test_a_profile_of_srgb_changes_nothing(tmp_path: Path) -> None:
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    picture = np.random.default_rng(0).integers(0, 256, (64, 64, 4)).astype(np.uint8)
    Image.fromarray(picture).save(tmp_path / "p.png", icc_profile=profile)
    np.testing.assert_array_equal(load_picture(tmp_path / "p.png"), picture)


def test_a_broken_profile_is_told(tmp_path: Path) -> None:
    picture = np.full((1, 1, 4), (128, 0, 255, 255), np.uint8)
    Image.fromarray(picture).save(tmp_path / "p.png", icc_profile=b"nonsense")
    with pytest.warns(LampblackWarning, match="profile"):
        np.testing.assert_array_equal(load_picture(tmp_path / "p.png"), picture)


@pytest.mark.parametrize("kind", ["PNG", "GIF", "TIFF"])
def test_further_pictures_in_a_file_are_told(tmp_path: Path, kind: str) -> None:
    first, second = (Image.new("RGB", (9, 9), colour) for colour in ("red", "blue"))
    first.save(tmp_path / "many.png", kind, save_all=True, append_images=[second])
    with pytest.warns(LampblackWarning, match="2 pictures"):
        assert load_picture(tmp_path / "many.png")[0, 0].tolist() == [255, 0, 0, 255]
