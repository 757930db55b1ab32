"""Export of the relief for other programs: GLB, OBJ or PLY."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh

from ..atomic import atomic_file
from ..errors import LampblackError
from .relief import Relief, check_relief

SUFFIXES = (".glb", ".obj", ".ply")


def save_mesh(relief: Relief, path: Path | str) -> None:
    """Write the mesh in canvas pixels, right-handed: x right, y *up* from the canvas's top
    edge (so the character lies at negative y), z towards the viewer.

    Raises:
        LampblackError: an unknown suffix, a mesh that is not sound, or a failed write.
    """
    target = Path(path)
    suffix = target.suffix.lower()
    if suffix not in SUFFIXES:
        raise LampblackError(
            f"The mesh cannot be written as {target.name!r}.",
            f"Choose a name that ends in {', '.join(SUFFIXES)}.",
        )
    wrong = check_relief(relief)
    if wrong:
        raise LampblackError(
            "The mesh of the relief has errors, so it was not written.",
            "Check the drawing, then try again.",
            " ".join(wrong),
        )
    vertices = relief.vertices * np.array([1, -1, 1], np.float32)
    mesh = trimesh.Trimesh(vertices, relief.faces, process=False)
    data = mesh.export(file_type=suffix[1:])
    with atomic_file(target) as file:
        file.write(data.encode() if isinstance(data, str) else bytes(data))
