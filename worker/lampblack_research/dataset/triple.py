"""One entry of a data set: drawings of a view, and its normal, depth and occlusion maps."""

from __future__ import annotations

import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lampblack.atomic import atomic_file
from lampblack.errors import LampblackError

from .gbuffer import GBuffer

MAX_SIDE = 4096
DEPTH_STEPS = 16
"""Levels of depth a pixel."""

IN_FRONT, BEHIND = 1, 2


@dataclass(frozen=True)
class Triple:
    """Drawings and truth, 8 or 16 bits a value.

    Attributes:
        drawings: (K, H, W) uint8, 255 is full ink; each in another line style.
        mask: (H, W) bool.
        normals: (H, W, 3) int8, 127 is 1; x right, y up, z to the viewer; 0 outside.
        depth: (H, W) uint16, towards the viewer, 1/16 pixel a level; 0 outside.
        occlusion: (H, W) uint8: ``IN_FRONT`` on the nearer side of every depth jump and along
            the silhouette, ``BEHIND`` on the farther side within the character, else 0.
    """

    drawings: NDArray[np.uint8]
    mask: NDArray[np.bool_]
    normals: NDArray[np.int8]
    depth: NDArray[np.uint16]
    occlusion: NDArray[np.uint8]

    @staticmethod
    def of(view: GBuffer, drawings: list[NDArray[np.float32]], step: float) -> Triple:
        """Quantise ``view`` and its ``drawings``; depth jumps of ``step`` pixels occlude."""
        return Triple(
            drawings=np.stack([np.round(lines * 255).astype(np.uint8) for lines in drawings]),
            mask=view.mask,
            normals=np.round(view.normals * 127).astype(np.int8),
            depth=np.clip(np.round(view.depth * DEPTH_STEPS), 0, 65535).astype(np.uint16),
            occlusion=occlusion_edges(view, step),
        )

    def save(self, path: Path) -> None:
        """Write an ``.npz`` archive, whole or not at all."""
        with atomic_file(path) as file:
            np.savez_compressed(
                file,
                drawings=self.drawings,
                mask=np.packbits(self.mask, axis=1),
                normals=self.normals,
                depth=self.depth,
                occlusion=self.occlusion,
            )

    @staticmethod
    def load(path: Path) -> Triple:
        """Read what ``save`` wrote.

        Raises:
            LampblackError: the file is not a triple.
        """
        try:
            with path.open("rb") as file, np.load(file, allow_pickle=False) as archive:
                normals = archive["normals"]
                height, width, _ = normals.shape
                if max(height, width) > MAX_SIDE:
                    raise ValueError(f"{width} x {height} pixels")
                mask = np.unpackbits(archive["mask"], axis=1, count=width).astype(bool)
                return Triple(
                    archive["drawings"], mask, normals, archive["depth"], archive["occlusion"]
                )
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
            raise LampblackError(
                f"{path} is not an entry of a data set.", "Remove it and build again.", str(error)
            ) from error


def entry_paths(folder: Path) -> list[Path]:
    """The entries of the data set in ``folder``. Those that are being written have other names."""
    return sorted(path for path in folder.rglob("[!.]*.npz") if path.is_file())


def occlusion_edges(view: GBuffer, step: float) -> NDArray[np.uint8]:
    """(H, W) uint8 map of the depth jumps of more than ``step`` pixels; see ``Triple``.

    Second differences of depth, so that a steep slope is no jump.
    """
    mask, depth = view.mask, view.depth
    found = np.zeros(mask.shape, np.uint8)
    front = np.zeros(mask.shape, bool)
    behind = np.zeros(mask.shape, bool)
    for axis in (0, 1):
        for shift in (1, -1):
            other, beyond = np.roll(depth, shift, axis), np.roll(depth, -shift, axis)
            there = np.roll(mask, shift, axis)
            near = mask & there & np.roll(mask, -shift, axis)
            jump = near & (depth - other > step) & (2 * depth - other - beyond > step / 2)
            front |= jump | (mask & ~there)
            behind |= np.roll(jump, -shift, axis)
    found[behind & mask] = BEHIND
    found[front] = IN_FRONT
    return found
