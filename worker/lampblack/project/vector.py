"""Vector layers, rendered by the installed Pencil2D, so that they look the same as there."""

from __future__ import annotations

import os
import shutil
import subprocess
import weakref
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
from defusedxml.ElementTree import fromstring
from numpy.typing import NDArray

from ..drawing import load_picture
from ..errors import ProjectError
from ..own_folder import own_folder
from .archive import Archive
from .document import Key, Layer
from .region import Region

PROGRAM = "pencil2d"
PALETTE = "palette.xml"
SECONDS = 600
MAX_BYTES = 256 << 20
"""Of the vector drawings of one layer; Pencil2D unpacks them into its temporary folder."""
KEPT_VARIABLES = ("PATH", "LANG")


@dataclass
class VectorPictures:
    """Exports a layer's drawings when the first of them is needed.

    Args:
        origin: Pencil2D's origin, (x, y) canvas pixels.
    """

    archive: Archive
    origin: tuple[int, int]
    _exported: dict[tuple[int, int], Path] = field(default_factory=dict)

    def picture(self, layer: Layer, key: Key, region: Region) -> NDArray[np.uint8]:
        """(H, W, 4) uint8, straight alpha: the part of a vector drawing in ``region``.

        Raises:
            ProjectError: Pencil2D is not installed or cannot render the layer.
        """
        if (layer.number, key.frame) not in self._exported:
            self._export(layer, region)
        return load_picture(self._exported[layer.number, key.frame])

    def _export(self, layer: Layer, region: Region) -> None:
        """Let Pencil2D render every keyframe as a frame, with a camera that shows ``region``."""
        program = shutil.which(PROGRAM)
        if program is None:
            raise ProjectError(
                f"{layer.name!r} is a vector layer. Only Pencil2D can draw it, and Pencil2D is not "
                "installed.",
                "Install Pencil2D (on Debian: apt-get install pencil2d), or leave the layer out: "
                f'--background "{layer.name}", or hide it.',
            )
        folder = own_folder()
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        project, keys = folder / "layer.pclx", [key for key in layer.keys if not key.blank]
        files = {name: f"{at}.vec" for at, name in enumerate({k.file for k in keys if k.file}, 1)}
        with zipfile.ZipFile(project, "w") as archive:
            left = MAX_BYTES
            for name, copy in [*files.items(), (PALETTE, PALETTE)]:
                if name in files or self.archive.has(name):
                    data = self.archive.read(name)
                    left -= len(data)
                    if left < 0:
                        raise ProjectError(
                            f"The drawings of {layer.name!r} are larger than "
                            f"{MAX_BYTES >> 20} MiB in all.",
                            f'Leave the layer out: --background "{layer.name}", or hide it.',
                        )
                    archive.writestr(f"data/{copy}", data)
            archive.writestr("main.xml", self._document(keys, files, region))
        self._run(program, project, folder / "frame.png", len(keys))
        for number, key in enumerate(keys, start=1):
            drawn = folder / f"frame{number:04d}.png"
            if not drawn.exists():
                raise ProjectError(
                    f"Pencil2D did not draw frame {key.frame} of the layer {layer.name!r}.",
                    "Open the project in Pencil2D and check the layer.",
                )
            self._exported[layer.number, key.frame] = drawn

    def _document(self, keys: Sequence[Key], files: Mapping[str, str], region: Region) -> bytes:
        document = ElementTree.Element("document")
        layers = ElementTree.SubElement(document, "object")
        camera = ElementTree.SubElement(
            layers, "layer", id="1", type="5", name="Camera", visibility="1",
            width=str(region.width), height=str(region.height),
        )  # fmt: skip
        dx = self.origin[0] - (region.left + region.width // 2) / region.scale
        dy = self.origin[1] - (region.top + region.height // 2) / region.scale
        view = {"r": "0", "s": f"{region.scale:.9g}", "dx": f"{dx:.9g}", "dy": f"{dy:.9g}"}
        ElementTree.SubElement(camera, "camera", {"frame": "1", **view})
        drawings = ElementTree.SubElement(
            layers, "layer", id="2", type="2", name="drawings", visibility="1"
        )
        for number, key in enumerate(keys, start=1):
            if key.inline:
                drawing: ElementTree.Element = fromstring(key.inline, forbid_entities=True)
                drawing.set("frame", str(number))
                drawings.append(drawing)
            else:
                ElementTree.SubElement(drawings, "image", frame=str(number), src=files[key.file])
        text: bytes = ElementTree.tostring(document, "utf-8")
        return b"<!DOCTYPE PencilDocument>\n" + text

    def _run(self, program: str, project: Path, output: Path, frames: int) -> None:
        """Run Pencil2D with its own home folder, apart from the user's settings and instances."""
        home = project.parent / "home"
        home.mkdir()
        own = {name: str(home) for name in ("HOME", "TMPDIR", "XDG_RUNTIME_DIR")}
        kept = {name: os.environ[name] for name in KEPT_VARIABLES if name in os.environ}
        home.chmod(0o700)
        try:
            done = subprocess.run(
                [program, str(project), "-o", str(output), "--start", "1", "--end", str(frames),
                 "--transparency"],
                cwd=home,
                env={**kept, **own, "QT_QPA_PLATFORM": "offscreen"},
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=SECONDS,
                check=False,
            )  # fmt: skip
        except (OSError, subprocess.TimeoutExpired) as error:
            raise ProjectError(
                "Pencil2D could not draw the vector layers.", "Try again.", str(error)
            ) from error
        if done.returncode:
            raise ProjectError(
                "Pencil2D could not draw the vector layers.",
                "Open the project in Pencil2D and check them.",
                done.stderr.decode(errors="replace")[-400:],
            )
