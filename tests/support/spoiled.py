"""Files that were sound once: samples of every kind that is read, and ways to spoil them.

Half of the spoiled files are spoiled inside: the checksum of a PNG's chunk or a zip's entry fits
again, so that a reader gets past the container to the content.
"""

from __future__ import annotations

import io
import json
import random
import struct
import warnings
import zipfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from PIL import Image

from lampblack.finals.exr import save_exr
from lampblack.looks import preset as style
from lampblack.rigs import preset as rig
from lampblack.scene import (
    Depth,
    DepthColour,
    DepthPoint,
    DepthStroke,
    default_scene,
    encode_rig,
    encode_scene,
    encode_style,
)
from support.drawings import draw_ball, draw_capsule
from support.projects import ARCH, document, image, layer, png

Spoil = Callable[[bytes, random.Random], bytes]

INTERESTING = (0, 1, 0x7F, 0x80, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF)
WORDS = (
    b"", b"-1", b"1e999", b"nan", b"99999999999999999999", b"../../etc/passwd", b"\xff\xfe", b"%s",
    b"&x;", b"<![CDATA[", b"\0", b"9" * 4000, b"[" * 4000, b"{" * 4000, b'"', b"true", b"null",
)  # fmt: skip


def spoiled(data: bytes, chance: random.Random) -> bytes:
    """``data`` with a few places overwritten, cut out, doubled or torn off."""
    made = bytearray(data)
    for _ in range(chance.choice((1, 1, 2, 5))):
        place = chance.randrange(len(made) + 1)
        kind = chance.randrange(7)
        if kind == 0:
            made[place : place + 1] = bytes([chance.randrange(256)])
        elif kind == 1:
            made[place : place + 4] = struct.pack("<I", chance.choice(INTERESTING))
        elif kind == 2:
            made[place : place + 4] = struct.pack(">I", chance.choice(INTERESTING))
        elif kind == 3:
            made[place:place] = chance.choice(WORDS)
        elif kind == 4:
            made[place : place + chance.randrange(1, 40)] = b""
        elif kind == 5:
            made[place:place] = made[place : place + chance.randrange(1, 200)]
        else:
            del made[max(1, place) :]
    return bytes(made)


def spoiled_png(data: bytes, chance: random.Random) -> bytes:
    """A PNG with one chunk spoiled, or put elsewhere, and checksums that fit."""
    chunks, place = [], 8
    while place < len(data):
        (length,) = struct.unpack(">I", data[place : place + 4])
        chunks.append((data[place + 4 : place + 8], data[place + 8 : place + 8 + length]))
        place += 12 + length
    index = chance.randrange(len(chunks))
    kind, content = chunks[index]
    match chance.randrange(5):
        case 0:
            chunks.insert(chance.randrange(len(chunks) + 1), (kind, content))
        case 1:
            del chunks[index]
        case 2:
            chunks[index] = chance.choice(
                (b"tRNS", b"PLTE", b"iCCP", b"zTXt", b"iTXt", b"eXIf", b"gAMA", b"acTL", b"fcTL")
            ), content  # fmt: skip
        case 3 if kind == b"IDAT":
            with suppress(zlib.error):  # of a picture in several chunks
                chunks[index] = kind, zlib.compress(spoiled(zlib.decompress(content), chance))
        case _:
            chunks[index] = kind, spoiled(content, chance)
    return data[:8] + b"".join(
        struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
        for name, body in chunks
    )


def spoiled_zip(data: bytes, chance: random.Random) -> bytes:
    """A zip with one entry spoiled, and checksums that fit."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        entries = [(info.filename, archive.read(info)) for info in archive.infolist()]
    index = chance.randrange(len(entries))
    name, content = entries[index]
    inner = spoiled_png if content.startswith(b"\x89PNG") and chance.random() < 0.7 else spoiled
    entries[index] = name, inner(content, chance)
    if chance.random() < 0.1:
        entries.append((chance.choice(("main.xml", "../x", "data/a.png", "stack.xml")), content))
    made = io.BytesIO()
    packing = chance.choice((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))
    with zipfile.ZipFile(made, "w", packing) as z, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of two entries with one name
        for entry, body in entries:
            z.writestr(zipfile.ZipInfo(entry), body)
    return made.getvalue()


def spoiled_json(data: bytes, chance: random.Random) -> bytes:
    """JSON with one value made absurd."""

    def inside(value: object) -> object:
        if isinstance(value, dict) and value and chance.random() < 0.9:
            key = chance.choice(list(value))
            return {**value, key: inside(value[key])}
        if isinstance(value, list) and value and chance.random() < 0.9:
            at = chance.randrange(len(value))
            return [inside(v) if i == at else v for i, v in enumerate(value)]
        return chance.choice(
            (None, -1, 0, 1e30, 10**30, "", "\ud800", "x" * 300, [], {}, True, [[[]]], [value] * 9)
        )

    return json.dumps(inside(json.loads(data))).encode(errors="surrogatepass")


def samples(folder: Path, layered: Path) -> dict[str, tuple[bytes, Spoil]]:
    """One sound file of every kind, by name, and how it is spoiled inside. ``layered`` holds files
    of other programs."""
    ball = draw_ball(48)
    bitmap = Image.fromarray(ball)
    found: dict[str, tuple[bytes, Spoil]] = {"a.png": (png(ball), spoiled_png)}
    indexed = io.BytesIO()
    bitmap.convert("RGB").quantize(8).save(indexed, "PNG", transparency=2)
    found["indexed.png"] = indexed.getvalue(), spoiled_png
    for suffix in ("jpg", "webp", "tif", "gif", "bmp", "tga"):
        file = io.BytesIO()
        bitmap.convert("RGB" if suffix in ("jpg", "bmp") else "RGBA").save(
            file, {"jpg": "JPEG", "tif": "TIFF"}.get(suffix, suffix.upper())
        )
        found[f"a.{suffix}"] = file.getvalue(), spoiled
    xml = document(
        [
            layer(2, "body", [image(1, "a.png", -20, -20), image(3, "b.png", -9, 4, 0.5)]),
            layer(3, "lines", [image(5, "c.vec")], kind=2),
        ]
    )
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        archive.writestr("main.xml", xml)
        archive.writestr("data/a.png", png(ball))
        archive.writestr("data/b.png", png(draw_capsule((48, 48), (8, 8), (40, 30), 6)))
        archive.writestr("data/c.vec", ARCH)
    found["a.pclx"] = made.getvalue(), spoiled_zip
    for path in sorted(layered.iterdir()):
        found[path.name] = path.read_bytes(), spoiled_zip if path.suffix == ".ora" else spoiled
    scene = default_scene(48, 48)
    found["scene.json"] = encode_scene(scene), spoiled_json
    found["rig.json"] = encode_rig(rig("three-point")), spoiled_json
    found["style.json"] = encode_style(style("two-tone-rim")), spoiled_json
    stroke = DepthStroke(1, (DepthPoint(3, 4), DepthPoint(9, 9)))
    hinted = replace(scene, depth=Depth(strokes=(stroke,), colours=(DepthColour("#ff0000"),)))
    depth = json.loads(encode_scene(hinted))["depth"]
    found["depth.json"] = json.dumps(depth).encode(), spoiled_json
    save_exr(folder / "sound.exr", {"": ball.astype("f4") / 255}, "now")
    found["a.exr"] = (folder / "sound.exr").read_bytes(), spoiled
    return found


def spoiled_files(
    kinds: dict[str, tuple[bytes, Spoil]], seed: int, count: int
) -> Iterator[tuple[str, bytes]]:
    """``count`` names with spoiled contents."""
    chance = random.Random(seed)
    for _ in range(count):
        name = chance.choice(list(kinds))
        data, inside = kinds[name]
        yield name, (inside if chance.random() < 0.5 else spoiled)(data, chance)
