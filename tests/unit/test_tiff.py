"""TIFF pictures of every kind that programs write: read rightly, or refused by name."""

from __future__ import annotations

import io
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, ImageCms

from lampblack import colour
from lampblack.drawing import load_picture
from lampblack.errors import DrawingError, LampblackWarning

GREY, RGB, RGB_ALPHA = 1, 3, 4
PREMULTIPLIED, STRAIGHT = 1, 2
FORMS = {"u": 1, "i": 2, "f": 3}


def tiff(samples: np.ndarray, order: str = "<", **more: bytes | int) -> bytes:
    """A TIFF of (H, W, channels) samples, uncompressed. ``more`` has tags by number:
    ``t338`` says what the fourth channel is, ``t34675`` is the ICC profile."""
    height, width, channels = samples.shape
    data = samples.astype(samples.dtype.newbyteorder(order)).tobytes()
    bits = samples.dtype.itemsize * 8
    tags: dict[int, tuple[int, ...] | bytes] = {
        256: (width,), 257: (height,), 258: (bits,) * channels, 259: (1,),
        262: (2 if channels >= RGB else 1,), 273: (8,), 277: (channels,), 278: (height,),
        279: (len(data),), 284: (1,), 339: (FORMS[samples.dtype.kind],) * channels,
    }  # fmt: skip
    for name, value in more.items():
        tags[int(name[1:])] = value if isinstance(value, bytes) else (value,)
    place = 8 + len(data)
    entries, blobs = b"", b""
    rest = place + 2 + 12 * len(tags) + 4
    for tag in sorted(tags):
        value = tags[tag]
        kind, count = (7, len(value)) if isinstance(value, bytes) else (4, len(value))
        body = value if isinstance(value, bytes) else struct.pack(f"{order}{len(value)}I", *value)
        if len(body) > 4:
            field = struct.pack(order + "I", rest + len(blobs))
            blobs += body
        else:
            field = body.ljust(4, b"\0")
        entries += struct.pack(order + "HHI", tag, kind, count) + field
    magic = b"II*\0" if order == "<" else b"MM\0*"
    head = magic + struct.pack(order + "I", place)
    ending = struct.pack(order + "H", len(tags)) + entries + bytes(4) + blobs
    return head + data + ending


def linear_profile() -> bytes:
    """sRGB without its curve."""
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    tags = {profile[132 + 12 * n : 136 + 12 * n]: n for n in range(profile[131])}
    made = bytearray(profile)
    for name in (b"rTRC", b"gTRC", b"bTRC"):
        entry = 132 + 12 * tags[name]
        place = int.from_bytes(made[entry + 4 : entry + 8], "big")
        made[place : place + 14] = b"curv\0\0\0\0" + struct.pack(">IH", 1, 256)
    return bytes(made)


def read(folder: Path, data: bytes) -> np.ndarray:
    path = folder / "a.tif"
    path.write_bytes(data)
    return load_picture(path)


def ramp(channels: int, kind: type = np.uint16) -> np.ndarray:
    """One row, from black to white and from clear to opaque."""
    most = np.iinfo(kind).max
    row = np.linspace(0, most, 120)[None, :, None]
    samples = np.repeat(row, channels, axis=2)
    return np.rint(samples).astype(kind)


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("channels", [GREY, RGB, RGB_ALPHA])
@pytest.mark.parametrize("kind", [np.uint8, np.uint16])
def test_whole_numbers_of_8_and_16_bits(
    tmp_path: Path, order: str, channels: int, kind: type
) -> None:
    samples = ramp(channels, kind)
    more = {"t338": STRAIGHT} if channels == RGB_ALPHA else {}
    found = read(tmp_path, tiff(samples, order, **more))
    expected = samples[..., 0] / np.iinfo(kind).max * 255
    assert np.abs(found[..., 1] - expected).max() <= 1
    assert np.abs(found[..., 3] - (expected if channels == RGB_ALPHA else 255)).max() <= 1


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize("alpha", [None, STRAIGHT, PREMULTIPLIED])
def test_linear_light_keeps_its_dark_tones(tmp_path: Path, order: str, alpha: int | None) -> None:
    light = np.arange(0, 2000, 7, np.uint16)
    samples = np.repeat(light[None, :, None], 3 if alpha is None else 4, axis=2)
    more: dict[str, bytes | int] = {"t34675": linear_profile()}
    if alpha is not None:
        samples[..., 3] = 0x8000
        more["t338"] = alpha
    found = read(tmp_path, tiff(samples, order, **more))
    share = 65535 / 0x8000 if alpha == PREMULTIPLIED else 1
    expected = colour.srgb(np.rint(light * share) / 65535) * 255
    assert np.abs(found[0, :, 1] - expected).max() <= 0.5 + 0.1
    assert (found[..., 3] == (255 if alpha is None else 128)).all()


@pytest.mark.parametrize("packing", ["raw", "tiff_lzw", "tiff_adobe_deflate", "packbits"])
def test_packed_pictures(tmp_path: Path, packing: str) -> None:
    file = io.BytesIO()
    picture = ramp(RGB, np.uint8).repeat(9, axis=0)
    Image.fromarray(picture).save(file, "TIFF", compression=packing)
    assert np.array_equal(read(tmp_path, file.getvalue())[..., :3], picture)


def test_packed_linear_light_keeps_its_dark_tones(tmp_path: Path) -> None:
    """Unpacked by another decoder, which has an order of bytes of its own."""
    light = np.arange(0, 2000, 7, np.uint16)
    samples = np.repeat(light[None, :, None], 3, axis=2)
    packed = packed_by_zip(tiff(samples, t34675=linear_profile()), samples.tobytes())
    found = read(tmp_path, packed)
    assert np.array_equal(found[0, :, 1], np.rint(colour.srgb(light / 65535) * 255))


def packed_by_zip(data: bytes, pixels: bytes) -> bytes:
    """``data`` with its ``pixels`` packed, their room kept."""
    packed = zlib.compress(pixels, 9)
    made = bytearray(data.replace(pixels, packed.ljust(len(pixels), b"\0")))
    directory = int.from_bytes(made[4:8], "little")
    for entry in range(directory + 2, directory + 2 + 12 * made[directory], 12):
        tag = int.from_bytes(made[entry : entry + 2], "little")
        if tag in (259, 279):
            value = 8 if tag == 259 else len(packed)
            made[entry + 8 : entry + 12] = value.to_bytes(4, "little")
    return bytes(made)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (tiff(np.zeros((2, 2, 1), np.float32)), "floating-point"),
        (tiff(np.zeros((2, 2, 3), np.float32)), "unusual channels"),
        (tiff(np.zeros((2, 2, 3), np.float16)), "unusual channels"),
        (tiff(np.zeros((2, 2, 1), np.int16)), "signed"),
        (tiff(np.zeros((2, 2, 1), np.uint32)), "32 bits"),
        (tiff(np.zeros((2, 2, 1), np.uint16), t262=0), "0 is white"),
        (tiff(np.zeros((2, 2, 3), np.uint16), t284=2), "plane"),
        (tiff(np.zeros((2, 2, 3), np.uint8), t262=8), "LAB"),
    ],
    ids=["float", "colour float", "half float", "signed", "32 bits", "white", "planes", "LAB"],
)  # fmt: skip
def test_what_would_be_read_wrongly_is_refused_by_name(
    tmp_path: Path, data: bytes, words: str
) -> None:
    with pytest.raises(DrawingError, match=words) as refused:
        read(tmp_path, data)
    assert "damaged" not in str(refused.value)


def test_further_pages_are_told(tmp_path: Path) -> None:
    file = io.BytesIO()
    page = Image.new("RGB", (4, 4), (9, 8, 7))
    page.save(file, "TIFF", save_all=True, append_images=[page])
    with pytest.warns(LampblackWarning, match="2 pictures"):
        read(tmp_path, file.getvalue())


def test_large_tiffs_are_read(tmp_path: Path) -> None:
    """Those whose places have 64 bits (BigTIFF)."""
    file = io.BytesIO()
    Image.new("RGB", (5, 4), (9, 8, 7)).save(file, "TIFF", big_tiff=True)
    assert file.getvalue().startswith(b"II+\0")
    assert (read(tmp_path, file.getvalue()) == (9, 8, 7, 255)).all()
