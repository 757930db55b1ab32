"""What the paint of a row of pixels reflects, for the compiled loop over byte layers."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compiled import compiled
from .byte_arguments import DIFFUSE, GLOSSY, GLOW, LIT, Paints, Planes


@compiled
def reflect_row(
    row: int, columns: Any, planes: Planes, paints: Paints, parts: int, light: Any, gleam: Any,
    base: Any, fill: Any, unlit: Any,
) -> None:  # fmt: skip
    """Write what pixels reflect and give to ``fill``, which is 0, and colours that are left as
    drawn to ``unlit``; (W, 3) scene-linear each.

    Args:
        parts: number of lights on parts of the character.
        light, gleam: (2, W, 3) on the pixel's own label, and on the second one where its kind
            differs, or there are such lights.
        base: (W, 3) scene-linear, the drawn colours.
    """
    labels, others, shares = planes.labels, planes.others, planes.shares
    kinds, swatches, gloss, emission = paints.kinds, paints.swatches, paints.gloss, paints.emission
    byte, one, zero = np.float32(1 / 255), np.float32(1), np.float32(0)
    for column in columns:
        label, other = labels[row, column], others[row, column]
        kind, mate = kinds[label], kinds[other]
        share = shares[row, column] * byte
        if share == 0 and kind & (GLOSSY | GLOW) == 0:
            # Most pixels.
            if kind & DIFFUSE:
                for c in range(3):
                    fill[column, c], unlit[column, c] = base[column, c] * light[0, column, c], zero
            continue
        second = 0 if mate == kind and parts == 0 else 1
        for c in range(3):
            theirs = min(base[column, c], share * swatches[other, c])
            unlit[column, c] = zero
            for one_of in range(2 if share > 0 else 1):
                worn, which, at = (other, mate, second) if one_of else (label, kind, 0)
                paint = theirs if one_of else base[column, c] - theirs
                if which & (LIT | GLOW) == 0:
                    unlit[column, c] += paint
                if which & GLOW:
                    fill[column, c] += paint * emission[worn]
                    if which & LIT == 0:
                        fill[column, c] += paint
                if which & DIFFUSE:
                    fill[column, c] += paint * light[at, column, c]
                if which & GLOSSY:
                    part = share if one_of else one - share
                    shine = gloss[worn] * gleam[at, column, c]
                    fill[column, c] += shine * (part if which & DIFFUSE else paint)
