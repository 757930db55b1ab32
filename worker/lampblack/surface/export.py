"""The relief as a file for other programs: GLB, OBJ or PLY."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

import numpy as np
import trimesh

from ..errors import LampblackError
from .relief import Relief, check_relief

SUFFIXES = (".glb", ".obj", ".ply")


def save_mesh(relief: Relief, path: Path | str) -> None:
    """Write the mesh in canvas pixels, right-handed: x right, y *up* from the canvas's top
    edge (so the figure lies at negative y), z towards the viewer.

    The file is written beside ``path`` and then takes its place, so a failure leaves an
    older file as it was.

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
            "The relief is not a sound mesh, so it was not written.",
            "Check the drawing, then try again.",
            " ".join(wrong),
        )
    vertices = relief.vertices * np.array([1, -1, 1], np.float32)
    mesh = trimesh.Trimesh(vertices, relief.faces, process=False)
    data = mesh.export(file_type=suffix[1:])
    try:
        _replace(target, data.encode() if isinstance(data, str) else bytes(data))
    except OSError as error:
        raise LampblackError(
            f"The mesh could not be written to {target}.",
            "Check that the folder exists and has room, and that you may write to it.",
            str(error),
        ) from error


def _replace(target: Path, data: bytes) -> None:
    """Write ``data`` to ``target`` in one step."""
    handle, temporary = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        Path(temporary).chmod(0o666 & ~_umask())
        Path(temporary).replace(target)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
