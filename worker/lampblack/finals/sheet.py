"""Sprite sheets: pictures that hold the frames of an animation in equal cells."""

from __future__ import annotations

import io
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..cache import digest
from ..camera import IDENTITY, Affine, on_canvas
from ..drawing import read_picture, save_picture
from ..drawing.load import MAX_PIXELS, MAX_SIDE, picture_bytes
from ..errors import LampblackError
from ..scene import Canvas, Scene
from ..shot import Cel, Picture, ShotFrame

MAX_CELLS = 4096
Sample = TypeVar("Sample", np.uint8, np.float32)
_CELLS = re.compile(r"(\d{1,4})[xX×](\d{1,4})")


def cells_of(text: str) -> tuple[int, int]:
    """Columns and rows of ``8x4``.

    Raises:
        LampblackError: the text says nothing of the kind, or too many.
    """
    match = _CELLS.fullmatch(text.strip())
    columns, rows = (int(match[1]), int(match[2])) if match else (0, 0)
    if not 0 < columns * rows <= MAX_CELLS:
        raise LampblackError(
            f"{text[:40]!r} is not a number of cells.",
            f"Write columns and rows, such as 8x4; {MAX_CELLS} cells are the most.",
        )
    return columns, rows


@dataclass
class SheetShot:
    """The cells of one picture as frames, from left to right and from top to bottom; empty ones are
    blank frames.

    Args:
        cells: columns and rows.
        mask, ink: as large as the sheet; see ``Cel``.

    Raises:
        LampblackError: the picture cannot be read, or be cut into such cells.
    """

    path: Path
    cells: tuple[int, int]
    mask: Picture | None = None
    ink: Picture | None = None
    frames: Sequence[ShotFrame] = field(init=False)
    canvas: Canvas = field(init=False)

    def __post_init__(self) -> None:
        picture = read_picture(io.BytesIO(picture_bytes(self.path)), str(self.path))
        columns, rows = self.cells
        height, width = picture.shape[:2]
        if width % columns or height % rows:
            raise LampblackError(
                f"{self.path.name} is {width} x {height} pixels, which cannot be cut into "
                f"{columns} x {rows} equal cells.",
                "Write columns first, then rows; or make the picture a multiple of the cells.",
            )
        for given, option in ((self.mask, "--mask"), (self.ink, "--ink")):
            if given is not None and given.shape != picture.shape:
                raise LampblackError(
                    f"The picture of {option} is not as large as the sheet.",
                    "Make it a sheet of the same size.",
                )
        self.canvas = Canvas(width // columns, height // rows)
        self._parts = [
            None if each is None else self._cut(each) for each in (picture, self.mask, self.ink)
        ]
        drawn = self._parts[0]
        assert drawn is not None
        self.frames = [
            ShotFrame(
                number,
                f"{self.path.stem}.{number:04d}.png",
                digest(*(None if part is None else part[number - 1] for part in self._parts)),
                blank=not drawn[number - 1][..., 3].any(),
            )
            for number in range(1, columns * rows + 1)
        ]

    def _cut(self, picture: Picture) -> list[Picture]:
        columns, rows = self.cells
        return [
            np.ascontiguousarray(cell)
            for row in np.split(picture, rows)
            for cell in np.split(row, columns, axis=1)
        ]

    def cel(self, frame: ShotFrame) -> Cel:
        assert frame.number is not None
        cell = frame.number - 1
        picture, mask, ink = (None if part is None else part[cell] for part in self._parts)
        assert picture is not None
        return Cel(picture, mask, ink)

    def place(self, frame: ShotFrame, scene: Scene, size: tuple[int, int]) -> Scene:
        return on_canvas(scene, self.canvas)

    def camera(self, frame: ShotFrame) -> Affine:
        return IDENTITY

    def finish(self, frame: ShotFrame, lit: NDArray[Sample]) -> NDArray[Sample]:
        return lit


def save_sheet(path: Path, pictures: Sequence[Picture | None], columns: int = 0) -> None:
    """Write pictures, (H, W, 4) uint8, into one sheet, in cells as large as the largest; None is an
    empty cell. Without ``columns`` the sheet is about square.

    Raises:
        LampblackError: the sheet is too large, or there is no picture. OutputError: it cannot be
            written.
    """
    sizes = [picture.shape[:2] for picture in pictures if picture is not None]
    if not sizes:
        raise LampblackError("There is no frame for the sheet.", "Leave out --sprite-sheet.")
    height, width = (max(size[axis] for size in sizes) for axis in (0, 1))
    columns = columns or math.ceil(math.sqrt(len(pictures) * height / width))
    columns = min(columns, len(pictures))
    rows = math.ceil(len(pictures) / columns)
    if max(rows * height, columns * width) > MAX_SIDE or (
        rows * height * columns * width > MAX_PIXELS
    ):
        raise LampblackError(
            f"A sheet of {columns} x {rows} frames would be {columns * width} x {rows * height} "
            "pixels, which is too large.",
            "Put fewer frames on a sheet (--frames), or leave out --sprite-sheet.",
        )
    sheet = np.zeros((rows * height, columns * width, 4), np.uint8)
    for index, picture in enumerate(pictures):
        if picture is not None:
            top, left = index // columns * height, index % columns * width
            sheet[top : top + picture.shape[0], left : left + picture.shape[1]] = picture
    save_picture(path, sheet)
