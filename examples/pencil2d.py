"""Write a Pencil2D project from drawings: main.xml and the keyframes' pictures in one zip."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from xml.etree import ElementTree as xml

import numpy as np
from numpy.typing import NDArray
from PIL import Image

CAMERA, BITMAP = "5", "1"


def write_project(
    path: Path, drawings: list[NDArray[np.uint8]], hold: int, fps: int, name: str
) -> None:
    """One bitmap layer ``name`` of (H, W, 4) drawings, each shown for ``hold`` frames.

    Pencil2D's origin is the middle of the camera, which shows the whole drawing.
    """
    height, width = drawings[0].shape[:2]
    document = xml.Element("document")
    data = xml.SubElement(document, "projectdata")
    last = str(hold * len(drawings))
    for tag, value in {
        "currentFrame": "1", "currentLayer": "1", "fps": str(fps), "isLoop": "true",
        "isRangedPlayback": "true", "markInFrame": "1", "markOutFrame": last,
    }.items():  # fmt: skip
        xml.SubElement(data, tag, value=value)
    layers = xml.SubElement(document, "object")
    camera = xml.SubElement(
        layers, "layer", id="1", type=CAMERA, name="Camera", visibility="1",
        width=str(width), height=str(height),
    )  # fmt: skip
    xml.SubElement(camera, "camera", frame="1", r="0", s="1", dx="0", dy="0")
    layer = xml.SubElement(layers, "layer", id="2", type=BITMAP, name=name, visibility="1")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as project:
        for index, drawing in enumerate(drawings):
            # Pencil2D moves a picture by its transparent margin at every load: leave none.
            picture = Image.fromarray(drawing)
            left, top, right, bottom = picture.getchannel("A").getbbox()
            frame, source = 1 + index * hold, f"002.{1 + index * hold:03d}.png"
            xml.SubElement(
                layer, "image", frame=str(frame), src=source, opacity="1",
                topLeftX=str(left - width // 2), topLeftY=str(top - height // 2),
            )  # fmt: skip
            png = io.BytesIO()
            picture.crop((left, top, right, bottom)).save(png, "PNG")
            _add(project, f"data/{source}", png.getvalue())
        xml.SubElement(document, "version").text = "0.6.6"
        xml.indent(document)
        text = b"<!DOCTYPE PencilDocument>\n" + xml.tostring(document, encoding="utf-8")
        _add(project, "main.xml", text)


def _add(project: zipfile.ZipFile, name: str, content: bytes) -> None:
    """With a fixed date, so that the file comes out the same on every run."""
    entry = zipfile.ZipInfo(name, (2000, 1, 1, 0, 0, 0))
    entry.compress_type = zipfile.ZIP_DEFLATED
    project.writestr(entry, content)
