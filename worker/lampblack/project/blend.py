"""Blend modes of layers, after W3C Compositing and Blending Level 1, and those that Photoshop and
Krita add to them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

Blend = Literal[
    "normal", "multiply", "screen", "overlay", "darken", "lighten", "color-dodge", "color-burn",
    "hard-light", "soft-light", "difference", "exclusion", "hue", "saturation", "color",
    "luminosity", "linear-dodge", "linear-burn", "vivid-light", "linear-light", "pin-light",
    "hard-mix", "subtract", "divide", "darker-color", "lighter-color",
    "plus", "dst-in", "dst-out", "dst-atop",
]  # fmt: skip
"""``plus``, ``dst-in`` and those after it are ways of compositing, without a blend of colours."""

BLENDS: tuple[Blend, ...] = get_args(Blend)

Floats = NDArray[np.float32]

_LUMA = np.array([0.3, 0.59, 0.11], np.float32)
_TINY = np.float32(1e-6)


def blended(
    below: Floats, above: Floats, blend: Blend, opacity: float, *, clipped: bool = False
) -> Floats:
    """``above`` on ``below``, both and the result (H, W, 4) float32 sRGB from 0 to 1 with straight
    alpha.

    Args:
        opacity: of ``above``, 0 to 1.
        clipped: ``above`` shows only where ``below`` is, whose alpha stays as it is.
    """
    ab, cb = below[..., 3:], below[..., :3]
    a, cs = above[..., 3:] * np.float32(opacity), above[..., :3]
    if blend in ("dst-in", "dst-out", "dst-atop"):
        kept = 1 - a if blend == "dst-out" else a
        added = a * (1 - ab) if blend == "dst-atop" else np.float32(0)
        alpha = ab * kept + added
        light = ab * cb * kept + cs * added
    elif blend == "plus":
        alpha = ab if clipped else np.minimum(ab + a, 1)
        light = np.minimum(ab * cb + a * cs * (ab if clipped else 1), alpha)
    else:
        mixed = (1 - ab) * cs + ab * _MIX[blend](cb, cs) if blend != "normal" else cs
        if clipped:
            mixed = _MIX[blend](cb, cs) if blend != "normal" else cs
            alpha, light = ab, ab * (a * mixed + (1 - a) * cb)
        else:
            alpha = a + ab * (1 - a)
            light = a * mixed + ab * cb * (1 - a)
    colour = light / np.maximum(alpha, _TINY)
    result: Floats = np.clip(np.concatenate([colour, alpha], axis=2), 0, 1)
    return result


def _screen(cb: Floats, cs: Floats) -> Floats:
    return cb + cs - cb * cs


def _hard_light(cb: Floats, cs: Floats) -> Floats:
    return np.where(cs <= 0.5, 2 * cb * cs, _screen(cb, 2 * cs - 1))


def _soft_light(cb: Floats, cs: Floats) -> Floats:
    curve = np.where(cb <= 0.25, ((16 * cb - 12) * cb + 4) * cb, np.sqrt(cb))
    dark = cb - (1 - 2 * cs) * cb * (1 - cb)
    return np.where(cs <= 0.5, dark, cb + (2 * cs - 1) * (curve - cb))


def _dodge(cb: Floats, cs: Floats) -> Floats:
    full = np.where(cb == 0, np.float32(0), np.float32(1))
    return np.where(cs < 1, np.minimum(1, cb / np.maximum(1 - cs, _TINY)), full)


def _burn(cb: Floats, cs: Floats) -> Floats:
    none = np.where(cb == 1, np.float32(1), np.float32(0))
    return np.where(cs > 0, 1 - np.minimum(1, (1 - cb) / np.maximum(cs, _TINY)), none)


def _vivid_light(cb: Floats, cs: Floats) -> Floats:
    """Burn or dodge, where black and white win over what is below."""
    burnt = 1 - np.minimum(1, (1 - cb) / np.maximum(2 * cs, _TINY))
    dodged = np.minimum(1, cb / np.maximum(2 * (1 - cs), _TINY))
    return np.where(cs >= 1, np.float32(1), np.where(cs <= 0.5, burnt * (cs > 0), dodged))


def _linear_light(cb: Floats, cs: Floats) -> Floats:
    return np.clip(cb + 2 * cs - 1, 0, 1)


def _pin_light(cb: Floats, cs: Floats) -> Floats:
    return np.where(cs > 0.5, np.maximum(cb, 2 * cs - 1), np.minimum(cb, 2 * cs))


def _hard_mix(cb: Floats, cs: Floats) -> Floats:
    total = cb + cs
    return np.asarray((total > 1) | ((total == 1) & (cb > 0.5)), np.float32)


def _luma(colour: Floats) -> Floats:
    return np.asarray((colour @ _LUMA)[..., None], np.float32)


def _with_luma(colour: Floats, luma: Floats) -> Floats:
    moved = colour + (luma - _luma(colour))
    least, most = moved.min(axis=2, keepdims=True), moved.max(axis=2, keepdims=True)
    low = luma + (moved - luma) * luma / np.maximum(luma - least, _TINY)
    moved = np.where(least < 0, low, moved)
    high = luma + (moved - luma) * (1 - luma) / np.maximum(most - luma, _TINY)
    return np.where(most > 1, high, moved)


def _range(colour: Floats) -> Floats:
    return np.asarray(np.ptp(colour, axis=2, keepdims=True))


def _with_range(colour: Floats, saturation: Floats) -> Floats:
    least = colour.min(axis=2, keepdims=True)
    stretched: Floats = (colour - least) * saturation / np.maximum(_range(colour), _TINY)
    return stretched


_MIX: dict[str, Callable[[Floats, Floats], Floats]] = {
    "multiply": lambda cb, cs: cb * cs,
    "screen": _screen,
    "overlay": lambda cb, cs: _hard_light(cs, cb),
    "darken": np.minimum,
    "lighten": np.maximum,
    "color-dodge": _dodge,
    "color-burn": _burn,
    "hard-light": _hard_light,
    "soft-light": _soft_light,
    "difference": lambda cb, cs: np.abs(cb - cs),
    "exclusion": lambda cb, cs: cb + cs - 2 * cb * cs,
    "linear-dodge": lambda cb, cs: np.minimum(1, cb + cs),
    "linear-burn": lambda cb, cs: np.maximum(0, cb + cs - 1),
    "vivid-light": _vivid_light,
    "linear-light": _linear_light,
    "pin-light": _pin_light,
    "hard-mix": _hard_mix,
    "subtract": lambda cb, cs: np.maximum(0, cb - cs),
    "divide": lambda cb, cs: np.minimum(1, cb / np.maximum(cs, _TINY)),
    "darker-color": lambda cb, cs: np.where(_luma(cs) < _luma(cb), cs, cb),
    "lighter-color": lambda cb, cs: np.where(_luma(cs) > _luma(cb), cs, cb),
    "hue": lambda cb, cs: _with_luma(_with_range(cs, _range(cb)), _luma(cb)),
    "saturation": lambda cb, cs: _with_luma(_with_range(cb, _range(cs)), _luma(cb)),
    "color": lambda cb, cs: _with_luma(cs, _luma(cb)),
    "luminosity": lambda cb, cs: _with_luma(cb, _luma(cs)),
}
"""B(Cb, Cs) of each mode, of the colours below and above."""
