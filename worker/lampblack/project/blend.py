"""Blend modes of layers, after W3C Compositing and Blending Level 1, and those that Photoshop and
Krita add to them."""

from __future__ import annotations

from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from ..compiled import compiled
from .blend_formulas import Mode, mix, mix_colours

Blend = Literal[
    "normal", "multiply", "screen", "overlay", "darken", "lighten", "color-dodge", "color-burn",
    "hard-light", "soft-light", "difference", "exclusion", "linear-dodge", "linear-burn",
    "vivid-light", "linear-light", "pin-light", "hard-mix", "subtract", "divide",
    "hue", "saturation", "color", "luminosity", "darker-color", "lighter-color",
    "plus", "dst-in", "dst-out", "dst-atop",
]  # fmt: skip
"""``plus``, ``dst-in`` and those after it are ways of compositing, without a blend of colours."""

BLENDS: tuple[Blend, ...] = get_args(Blend)
_MODES = {blend: Mode[blend.upper().replace("-", "_")] for blend in BLENDS}

Floats = NDArray[np.float32]

_TINY = np.float32(1e-6)


def blended(
    below: Floats, above: Floats, blend: Blend, opacity: float, *, clipped: bool = False
) -> Floats:
    """``above`` on ``below``, both and the result (H, W, 4) float32 sRGB from 0 to 1 with straight
    alpha; see ``blend_onto``."""
    result = below.copy()
    blend_onto(result, above, blend, opacity, clipped=clipped)
    return result


def blend_onto(
    canvas: Floats,
    above: Floats | NDArray[np.uint8],
    blend: Blend,
    opacity: float,
    *,
    clipped: bool = False,
) -> None:
    """Blend ``above`` with ``canvas``, both (H, W, 4) sRGB with straight alpha, from 0 to 1, or
    bytes.

    Args:
        opacity: of ``above``, 0 to 1.
        clipped: ``above`` shows only where ``canvas`` is, whose alpha stays as it is.
    """
    most = np.float32(255 if above.dtype == np.uint8 else 1)
    _blend_pixels(canvas, above, most, np.float32(opacity), int(_MODES[blend]), clipped)


@compiled
def _blend_pixels(
    canvas: Any, above: Any, most: Any, opacity: Any, mode: int, clipped: bool
) -> None:
    plain = mode == Mode.NORMAL
    of_all = mode >= Mode.HUE and mode < Mode.PLUS
    of_each = mode < Mode.HUE and not plain
    needs_above = mode != Mode.DST_IN and mode != Mode.DST_ATOP
    cs, mixed = np.empty(3, np.float32), np.empty(3, np.float32)
    for row in range(above.shape[0]):
        for column in range(above.shape[1]):
            pixel, front = canvas[row, column], above[row, column]
            a, ab = np.float32(front[3]) / most * opacity, pixel[3]
            if a == 0 and needs_above:
                continue
            for i in range(3):
                cs[i] = np.float32(front[i]) / most
            # The light of what is above, and that of what is below, in what comes out.
            shown, kept, alpha = _shares(mode, a, ab, clipped)
            both = np.float32(1) if clipped else ab
            if of_all:
                mix_colours(mode, pixel, cs, mixed)
            for i in range(3):
                colour = cs[i]
                if of_each:
                    colour += both * (mix(mode, pixel[i], cs[i]) - cs[i])
                elif of_all:
                    colour += both * (mixed[i] - cs[i])
                light = min(shown * colour + kept * pixel[i], alpha)
                pixel[i] = min(max(light / max(alpha, _TINY), 0), 1)
            pixel[3] = min(max(alpha, 0), 1)


@compiled
def _shares(mode: int, a: Any, ab: Any, clipped: bool) -> Any:
    """How much light of what is above and of what is below comes out, and the alpha."""
    if mode == Mode.PLUS:
        alpha = ab if clipped else min(ab + a, np.float32(1))
        return a * (ab if clipped else np.float32(1)), ab, alpha
    if mode == Mode.DST_OUT:
        return np.float32(0), ab * (1 - a), ab * (1 - a)
    if mode == Mode.DST_IN:
        return np.float32(0), ab * a, ab * a
    if mode == Mode.DST_ATOP:
        return a * (1 - ab), ab * a, ab * a + a * (1 - ab)
    if clipped:
        return ab * a, ab * (1 - a), ab
    return a, ab * (1 - a), a + ab * (1 - a)
