"""The layers of a drawing as files, for a program that shows them and cannot read the drawing."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

from ..atomic import atomic_file
from ..camera import IDENTITY, Affine
from ..errors import DrawingError, LampblackError, OutputError
from ..project import is_project, read_project
from ..project.apart import ProjectLayers
from ..shot import LayeredShot, PaintedLayer, PictureLayer, Shot, by_number
from .resolve import ResolvedShot, resolve_shot
from .settings import RenderSettings

MAX_BYTES = 2 << 30
"""Of all files together: the folder may lie in memory."""
LAYER = "Drawing"
"""The one layer of a drawing that has none."""
_MADE = re.compile(r"[0-9a-f]{40}\.png")

Record = dict[str, Any]


class SequenceLayers:
    """Picture files, each a frame with one layer. A frame that is missing shows the one before."""

    fps = 12
    layers: Sequence[PictureLayer] = (PictureLayer(LAYER, visible=True),)

    def __init__(self, resolved: ResolvedShot) -> None:
        self._shot: Shot = resolved.shot
        self._frames = by_number(resolved.frames)
        first, last = min(self._frames), max(self._frames)
        if first < 0:
            raise DrawingError(f"There is a frame {first}.", "Number the files from 0 or 1.")
        self.numbers: Sequence[int] = range(first, last + 1)
        height, width = self._shot.cel(self._frames[first]).pixels.shape[:2]
        self.size = width, height

    def view(self, number: int) -> Affine:
        return IDENTITY

    def painted(self, number: int) -> list[PaintedLayer]:
        held = max(each for each in self._frames if each <= number)
        frame = self._frames[held]
        return [PaintedLayer(LAYER, frame.drawing, lambda: self._shot.cel(frame).pixels)]

    def whole(self, number: int) -> PaintedLayer | None:
        return None


def open_layers(drawing: str) -> LayeredShot:
    """The layers of a project, a drawing with layers, a picture, or a sequence of these.

    Raises:
        LampblackError: it is missing or malformed.
    """
    if is_project(drawing) and Path(drawing).exists():
        return ProjectLayers(*read_project(drawing))
    return SequenceLayers(resolve_shot(RenderSettings(inputs=(drawing,), output="")))


def write_layers(shot: LayeredShot, folder: Path, first: int = 0) -> Iterator[Record]:
    """Write every picture once, named after what it shows; files that are there are kept. In the
    end, those of an earlier call that are shown no longer are removed.

    Args:
        first: the frame to begin with.

    Yields:
        The shot (``canvas``, ``fps``, ``first`` and ``last``, ``layers`` bottom first); then for
        each frame its ``view``, and the ``files`` of its layers by name. A frame that cannot be
        read has an ``error``.

    Raises:
        OutputError: the folder is full.
    """
    yield {
        "canvas": shot.size,
        "fps": shot.fps,
        "first": shot.numbers[0],
        "last": shot.numbers[-1],
        "layers": [{"name": one.name, "visible": one.visible} for one in shot.layers],
    }
    store = _Store(folder)
    start = first - shot.numbers[0] if first in shot.numbers else 0
    for number in (*shot.numbers[start:], *shot.numbers[:start]):
        try:
            whole = shot.whole(number)
            record: Record = {
                "files": {one.name: store.file(one) for one in shot.painted(number)},
                "whole": None if whole is None else store.file(whole),
            }
        except DrawingError as error:
            record = {"error": as_record(error)}
        yield {"frame": number, "view": shot.view(number), **record}
    store.remove_others()


def as_record(error: LampblackError) -> Record:
    return {"what": error.what, "remedy": error.remedy, "details": error.details}


class _Store:
    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._names: set[str] = set()
        self._bytes = 0

    def file(self, layer: PaintedLayer) -> str:
        """The name of the layer's picture, which is written if it is not there."""
        name = f"{layer.identity}.png"
        if name in self._names:
            return name
        path = self._folder / name
        if not path.exists():
            with atomic_file(path) as file:
                Image.fromarray(np.ascontiguousarray(layer.paint())).save(
                    file, "PNG", compress_level=1
                )
        self._names.add(name)
        self._bytes += path.stat().st_size
        if self._bytes > MAX_BYTES:
            raise OutputError(
                f"The layers of all frames need more than {MAX_BYTES >> 30} GiB.",
                "Open a part of the shot.",
            )
        return name

    def remove_others(self) -> None:
        for path in self._folder.iterdir():
            if _MADE.fullmatch(path.name) and path.name not in self._names:
                path.unlink(missing_ok=True)
