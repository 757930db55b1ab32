"""B(Cb, Cs) of each blend mode: the colour that what is above makes of the colour below."""

from __future__ import annotations

import math
from enum import IntEnum
from typing import Any

import numpy as np

from ..compiled import compiled

Mode = IntEnum(
    "Mode",
    "NORMAL MULTIPLY SCREEN OVERLAY DARKEN LIGHTEN COLOR_DODGE COLOR_BURN HARD_LIGHT SOFT_LIGHT "
    "DIFFERENCE EXCLUSION LINEAR_DODGE LINEAR_BURN VIVID_LIGHT LINEAR_LIGHT PIN_LIGHT HARD_MIX "
    "SUBTRACT DIVIDE HUE SATURATION COLOR LUMINOSITY DARKER_COLOR LIGHTER_COLOR "
    "PLUS DST_IN DST_OUT DST_ATOP",
)
"""Those that mix each channel by itself come first, then those that look at all three from ``HUE``
on, then ways of compositing from ``PLUS`` on, which mix no colours."""

_TINY = np.float32(1e-6)
_ZERO, _ONE = np.float32(0), np.float32(1)


@compiled
def mix(mode: Any, cb: Any, cs: Any) -> Any:
    """One channel of a mode that mixes each by itself."""
    if mode == Mode.MULTIPLY:
        return cb * cs
    if mode == Mode.SCREEN:
        return cb + cs - cb * cs
    if mode == Mode.OVERLAY:
        return _hard_light(cs, cb)
    if mode == Mode.DARKEN:
        return min(cb, cs)
    if mode == Mode.LIGHTEN:
        return max(cb, cs)
    if mode == Mode.COLOR_DODGE:
        return min(_ONE, cb / max(1 - cs, _TINY)) if cs < 1 else (_ONE if cb != 0 else _ZERO)
    if mode == Mode.COLOR_BURN:
        return 1 - min(_ONE, (1 - cb) / max(cs, _TINY)) if cs > 0 else (_ONE if cb == 1 else _ZERO)
    if mode == Mode.HARD_LIGHT:
        return _hard_light(cb, cs)
    if mode == Mode.SOFT_LIGHT:
        return _soft_light(cb, cs)
    if mode == Mode.DIFFERENCE:
        return abs(cb - cs)
    if mode == Mode.EXCLUSION:
        return cb + cs - 2 * cb * cs
    if mode == Mode.LINEAR_DODGE:
        return min(_ONE, cb + cs)
    if mode == Mode.LINEAR_BURN:
        return max(_ZERO, cb + cs - 1)
    if mode == Mode.VIVID_LIGHT:
        return _vivid_light(cb, cs)
    if mode == Mode.LINEAR_LIGHT:
        return min(max(cb + 2 * cs - 1, _ZERO), _ONE)
    if mode == Mode.PIN_LIGHT:
        return max(cb, 2 * cs - 1) if cs > 0.5 else min(cb, 2 * cs)
    if mode == Mode.HARD_MIX:
        return _ONE if cb + cs > 1 or (cb + cs == 1 and cb > 0.5) else _ZERO
    if mode == Mode.SUBTRACT:
        return max(_ZERO, cb - cs)
    return min(_ONE, cb / max(cs, _TINY))  # DIVIDE


@compiled
def _hard_light(cb: Any, cs: Any) -> Any:
    over = 2 * cs - 1
    return 2 * cb * cs if cs <= 0.5 else cb + over - cb * over


@compiled
def _soft_light(cb: Any, cs: Any) -> Any:
    if cs <= 0.5:
        return cb - (1 - 2 * cs) * cb * (1 - cb)
    curve = ((16 * cb - 12) * cb + 4) * cb if cb <= 0.25 else math.sqrt(cb)
    return cb + (2 * cs - 1) * (curve - cb)


@compiled
def _vivid_light(cb: Any, cs: Any) -> Any:
    """Burn or dodge, where black and white win over what is below."""
    if cs >= 1:
        return _ONE
    if cs > 0.5:
        return min(_ONE, cb / max(2 * (1 - cs), _TINY))
    return 1 - min(_ONE, (1 - cb) / max(2 * cs, _TINY)) if cs > 0 else _ZERO


@compiled
def mix_colours(mode: Any, cb: Any, cs: Any, mixed: Any) -> None:
    """All channels of a mode that looks at all of them, as ``mixed``."""
    if mode == Mode.DARKER_COLOR or mode == Mode.LIGHTER_COLOR:
        darker = _luma(cs) < _luma(cb)
        lighter = _luma(cs) > _luma(cb)
        wins = darker if mode == Mode.DARKER_COLOR else lighter
        for i in range(3):
            mixed[i] = cs[i] if wins else cb[i]
        return
    if mode == Mode.HUE or mode == Mode.SATURATION:
        hue, other = (cs, cb) if mode == Mode.HUE else (cb, cs)
        least = min(hue[0], hue[1], hue[2])
        stretch = _range(other) / max(_range(hue), _TINY)
        for i in range(3):
            mixed[i] = (hue[i] - least) * stretch
    else:
        for i in range(3):
            mixed[i] = cs[i] if mode == Mode.COLOR else cb[i]
    _set_luma(mixed, _luma(cs if mode == Mode.LUMINOSITY else cb))


@compiled
def _luma(colour: Any) -> Any:
    return np.float32(0.3) * colour[0] + np.float32(0.59) * colour[1] + np.float32(0.11) * colour[2]


@compiled
def _range(colour: Any) -> Any:
    return max(colour[0], colour[1], colour[2]) - min(colour[0], colour[1], colour[2])


@compiled
def _set_luma(colour: Any, luma: Any) -> None:
    """Move a colour to ``luma``, and towards grey until it is a colour."""
    away = luma - _luma(colour)
    for i in range(3):
        colour[i] += away
    least, most = min(colour[0], colour[1], colour[2]), max(colour[0], colour[1], colour[2])
    for i in range(3):
        if least < 0:
            colour[i] = luma + (colour[i] - luma) * luma / max(luma - least, _TINY)
        if most > 1:
            colour[i] = luma + (colour[i] - luma) * (1 - luma) / max(most - luma, _TINY)
