"""Files of Krita, written for tests."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from support.projects import png

NAMESPACE = 'xmlns="http://www.calligra.org/DTD/krita"'


def tiles(picture: NDArray[np.uint8], *, packed: bool = True) -> bytes:
    """The file of a layer of (H, W, 4) RGBA, or of a mask, (H, W)."""
    samples = picture[..., [2, 1, 0, 3]] if picture.ndim == 3 else picture[..., None]
    height, width, count = samples.shape
    places = [(x, y) for y in range(0, height, 64) for x in range(0, width, 64)]
    header = f"VERSION 2\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE {count}\nDATA {len(places)}\n"
    data = [header.encode()]
    for x, y in places:
        tile = np.zeros((64, 64, count), np.uint8)
        part = samples[y : y + 64, x : x + 64]
        tile[: part.shape[0], : part.shape[1]] = part
        content = b"\1" + _packed(tile.transpose(2, 0, 1).tobytes())
        if not packed or len(content) > tile.nbytes:
            content = b"\0" + tile.tobytes()
        data += [f"{x},{y},LZF,{len(content)}\n".encode(), content]
    return b"".join(data)


def _packed(data: bytes) -> bytes:
    """LZF: runs of one byte as references to the byte before, and the rest as it is."""
    out, at = bytearray(), 0
    while at < len(data):
        run = 1
        while at + run < len(data) and data[at + run] == data[at] and run < 200:
            run += 1
        out += bytes([0, data[at]])
        at += 1
        left = run - 1
        if left >= 9:
            out += bytes([7 << 5, left - 9, 0])
            at += left
    return bytes(out)


def paint_layer(name: str, file: str, **how: object) -> str:
    return element("paintlayer", name, file, "", how)


def group_layer(name: str, layers: str, **how: object) -> str:
    own = str(how.pop("masks", "")).removeprefix("<masks>").removesuffix("</masks>")
    return element("grouplayer", name, "none", f"<layers>{own}{layers}</layers>", how)


def element(kind: str, name: str, file: str, inner: str, how: Mapping[str, object]) -> str:
    masks = how.get("masks", "")
    usual = {"opacity": 255, "visible": 1, "compositeop": "normal", "x": 0, "y": 0}
    usual |= {"colorspacename": "RGBA", "channelflags": ""}
    given = {**usual, **{k: v for k, v in how.items() if k != "masks"}}
    attributes = " ".join(f'{key}="{value}"' for key, value in given.items())
    named = f'nodetype="{kind}" name="{name}" filename="{file}"'
    return f"<layer {named} {attributes}>{inner}{masks}</layer>"


def mask(file: str, **how: object) -> str:
    kind = how.pop("nodetype", "transparencymask")
    attributes = " ".join(f'{k}="{v}"' for k, v in ({"x": 0, "y": 0, "visible": 1} | how).items())
    return f'<masks><mask nodetype="{kind}" name="m" filename="{file}" {attributes}/></masks>'


def write_kra(
    path: Path, layers: str, files: Mapping[str, bytes], size: tuple[int, int] = (96, 72),
    *, space: str = "RGBA", last: int = 100,
) -> Path:  # fmt: skip
    """A file of Krita; ``files`` go to the folder of layers."""
    width, height = size
    xml = (
        '<?xml version="1.0" encoding="UTF-8"?><!DOCTYPE DOC PUBLIC \'-//KDE//DTD krita 2.0//EN\' '
        "'http://www.calligra.org/DTD/krita-2.0.dtd'>"
        f'<DOC {NAMESPACE} syntaxVersion="2.0" '
        f'kritaVersion="5.1.5"><IMAGE name="hero" width="{width}" height="{height}" '
        f'mime="application/x-kra" description="" colorspacename="{space}" '
        f'profile="sRGB-elle-V2-srgbtrc.icc" x-res="75" y-res="75">'
        f"<layers>{layers}</layers><animation>"
        f'<framerate type="value" value="12"/><range type="timerange" from="0" to="{last}"/>'
        "</animation></IMAGE></DOC>"
    )
    merged = np.full((height, width, 4), (10, 20, 30, 255), np.uint8)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("mimetype", "application/x-krita", zipfile.ZIP_STORED)
        archive.writestr("maindoc.xml", xml)
        archive.writestr("mergedimage.png", png(merged))
        for name, content in files.items():
            archive.writestr(f"hero/layers/{name}", content)
            if not name.endswith((".xml", ".defaultpixel")):
                size_of_pixel = 1 if name.endswith(".pixelselection") else 4
                archive.writestr(f"hero/layers/{name}.defaultpixel", bytes(size_of_pixel))
    return path


def keyframes(*keys: tuple[int, str, int, int]) -> bytes:
    """The file of the keyframes of a layer: (time, file, x, y) of each."""
    inner = "".join(
        f'<keyframe time="{time}" frame="{file}" color-label="0">'
        f'<offset type="point" x="{x}" y="{y}"/></keyframe>'
        for time, file, x, y in keys
    )
    return (
        '<?xml version="1.0"?><keyframes xmlns="http://www.calligra.org/DTD/krita-keyframes">'
        f'<channel name="content">{inner}</channel></keyframes>'
    ).encode()
