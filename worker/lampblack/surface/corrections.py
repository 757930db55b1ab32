"""What the artist corrects on a surface: strokes of a brush, and the volumes of colours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..scene import DepthColour, DepthStroke
from .brush import brushed, humped, turned
from .cuts import Cuts
from .volumes import Volume, with_volumes

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Corrections:
    """All corrections of one surface, in its own pixels."""

    strokes: tuple[DepthStroke, ...] = ()
    volumes: tuple[Volume, ...] = ()

    @staticmethod
    def of(
        strokes: Sequence[DepthStroke],
        colours: Sequence[DepthColour],
        labels: NDArray[np.int16],
        names: Sequence[str],
        length: float,
    ) -> Corrections:
        """
        Args:
            labels: (H, W) index into ``names``, the flat colours; -1 outside.
            length: of the character, in pixels.
        """
        volumes = [
            Volume(labels == names.index(said.colour), said.volume, said.nearer * length)
            for said in colours
            if said.colour in names
        ]
        return Corrections(tuple(strokes), tuple(volumes))

    def __bool__(self) -> bool:
        return bool(self.strokes or self.volumes)

    def normals(self, normals: Floats, mask: Mask) -> Floats:
        """The normals to inflate, of any length: see ``turned``."""
        return turned(normals, mask, self.strokes)

    def height(self, height: Floats, mask: Mask, cuts: Cuts) -> Floats:
        """The inflated surface, corrected: first its volumes, then by the brush."""
        if self.volumes:
            height = with_volumes(height, mask, cuts, self.volumes, character_length(mask))
        return humped(height, mask, cuts, self.strokes)

    def touched(self, mask: Mask) -> Mask:
        """(H, W) bool: where the surface is another."""
        found = brushed(mask, self.strokes)
        for volume in self.volumes:
            found |= volume.region & mask
        return found


def character_length(mask: Mask) -> float:
    """The longer side of the box around a character, in pixels; 0 without one."""
    return float(max(mask.any(axis=1).sum(), mask.any(axis=0).sum()))


def normals_of(height: Floats, mask: Mask) -> Floats:
    """(H, W, 3) unit normals of a height, x right, y up, z to the viewer; 0 outside the mask. Of
    the slopes to either side the gentler counts, so a step has no slope."""
    slopes = []
    for axis in (1, 0):
        step = np.diff(height, axis=axis)
        both = np.diff(mask.astype(np.int8), axis=axis) == 0
        step = np.where(both, step, np.float32(0))
        zero = np.zeros_like(np.take(height, [0], axis))
        before, after = np.concatenate([zero, step], axis), np.concatenate([step, zero], axis)
        alike = before * after > 0
        gentle = np.where(abs(before) < abs(after), before, after)
        # Twice the gentler of two: their mean if they are about the same.
        mean = (before + after) / 2
        slopes.append(np.where(alike & (abs(mean) < 2 * abs(gentle)), mean, gentle * alike))
    normals = np.dstack([-slopes[0], slopes[1], np.ones_like(height)])
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    return np.asarray(normals * mask[..., None], np.float32)
