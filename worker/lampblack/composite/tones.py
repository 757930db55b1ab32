"""Tones: traced light in flat steps, as in cel animation, and the colour of the shade.

The amount of direct light is a share of the full light, that of a surface that faces the strongest
light. It is smoothed before it is compared with the thresholds, and enlarged by splines: so the
edges of the tones are clean curves, at whatever resolution the light was traced.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..colour import hex_linear
from ..compiled import compiled
from ..scene import Look, Scene
from .blur import blurred
from .full_light import exposure, full_light, hue_of_lights, reach_of_light
from .illumination import Illumination
from .islands import without_islands
from .linking import Link
from .resample import Band, Box, enlarge
from .scan import levels_of_row, places, sides_of_row, step_of
from .shadowed import cast_shadow, reflected_into_shade
from .spline import refined
from .sums import add_up, brightest_of

SMOOTHING = 0.003
"""Deviation of the smoothing, as a share of the canvas's longer side."""
ISLAND = 0.022
"""Side of the smallest island of a tone, as a share of the canvas's longer side."""
FAINT = np.float32(0.02)
MOST = 3
"""How often light is enlarged at most, along each side, before the rest is interpolated."""
CEL = Look(tones=(0.42,), shade_strength=0.5)
"""The tones of a material in tones, in a scene without any."""
FLOOR_TONE = 0.25
_NONE = np.zeros((1, 1), np.float32)

Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Tones:
    """Light that was traced, ready to be shown in tones.

    Attributes:
        amount: (h, w) direct light as a share of the full light, linear.
        shine: (h, w) glossy light in the same measure.
        lit: (h, w, 3) scene-linear, the light of the brightest tone.
        shade: (3,) the light of the darkest, where surfaces turn away from the light.
        cast: (h, w) where something is in the way of the light, see ``cast_shadow``; (1, 1) if cast
            shadows have no tone of their own. cast_shade: (3,) the light there. cast_steps: where
            the step to it begins and ends, (1,) each.
        lows, highs: (n,) where each step begins and ends. highlight: (2,) the same of highlights.
        tint: (3,) what smooth light becomes in full shade. strength: how far.
    """

    amount: Floats
    shine: Floats
    lit: Floats
    shade: Floats
    cast: Floats
    cast_shade: Floats
    cast_steps: tuple[Floats, Floats]
    lows: Floats
    highs: Floats
    highlight: Floats
    tint: Floats
    strength: np.float32


def tones_of(
    illumination: Illumination, scene: Scene, pixel: float, area: Box, *, shine: bool = False
) -> Tones:
    """The tones of the character's light.

    Args:
        pixel: width of a pixel of the result, in pixels of the drawing.
        area: what the light covers, in pixels of the drawing.
        shine: whether there are highlights.
    """
    look = scene.look if scene.look.tones else replace(CEL, shade_colour=scene.look.shade_colour)
    direct = add_up([(weight, light) for weight, light, _ in illumination.direct])
    full = np.float32(full_light(scene) or (1.0 if illumination.direct else 0.0))
    height, width = direct.shape[:2]
    element = max(area[2] / width, area[3] / height)
    longest = max(scene.canvas.width, scene.canvas.height)
    blur = max(0.6, SMOOTHING * longest / element)
    brightest = brightest_of(direct)
    reach = reach_of_light(scene, area, (height, width)) if full_light(scene) > 0 else full
    lows, highs = steps(look)
    smallest = round((ISLAND * longest / element) ** 2)
    form, cast = illumination.form if full_light(scene) > 0 else None, _NONE
    if full > 0:
        steady = brightest
        if form is not None and scene.floor is not None:
            traced = brightest_of(add_up([(w, light) for w, light, _ in illumination.character]))
            steady = brightest - reflected_into_shade(traced, form, scene, area, float(full))
        amount = blurred(steady / reach, blur)
        if form is not None and look.tones and look.cast_strength > 0:
            cast = blurred(cast_shadow(amount, reach, form, scene, area, float(lows[0])), blur)
            cast = without_islands(cast, *cast_steps(look), smallest)
        amount = without_islands(amount, lows, highs, smallest)
    else:
        amount = np.ones((height, width), np.float32)
    ambient = hex_linear(scene.ambient.colour) * np.float32(scene.ambient.strength)
    scale = exposure(float(ambient.max() + full))
    faint = FAINT * full + np.float32(1e-6)
    lit = np.empty((height, width, 3), np.float32)
    _tint(
        direct,
        brightest,
        faint,
        hue_of_lights(scene),
        scale * ambient,
        np.float32(scale) * full,
        lit,
    )
    tint = hex_linear(look.shade_colour) * np.float32(scale * (ambient.max() + full))
    shade = (scale * ambient + look.shade_strength * (tint - scale * ambient)).astype(np.float32)
    deep = hex_linear(look.cast_colour) * np.float32(scale * (ambient.max() + full))
    factor = min(MOST, max(1, math.ceil(element / pixel / 2)))
    edge = np.float32(look.highlight**2), np.float32((look.highlight + look.softness / 2) ** 2)
    mirrored = np.zeros((1, 1), np.float32)
    if shine and full > 0:
        glossy = add_up([(weight, light) for weight, _, light in illumination.direct])
        mirrored = refined(blurred(brightest_of(glossy) / full, blur), factor)
    return Tones(
        amount=refined(np.ascontiguousarray(amount, np.float32), factor),
        shine=mirrored,
        lit=lit,
        shade=shade,
        cast=refined(np.ascontiguousarray(cast, np.float32), factor if cast is not _NONE else 1),
        cast_shade=(shade + look.cast_strength * (deep - shade)).astype(np.float32),
        cast_steps=cast_steps(look),
        lows=lows,
        highs=highs,
        highlight=np.array(edge, np.float32),
        tint=tint.astype(np.float32),
        strength=np.float32(scene.look.shade_strength),
    )


def toned_part(light: Floats, link: Link, scene: Scene, area: Box) -> Floats:
    """The light of those that light only ``link``, in tones, (h, w, 3): it is added to the tones of
    all others. It is as large as tones are enlarged at most."""
    full = np.float32(full_light(scene, link))
    if full <= 0:
        return light
    height, width = light.shape[:2]
    element = max(area[2] / width, area[3] / height)
    longest = max(scene.canvas.width, scene.canvas.height)
    brightest = brightest_of(light)
    reach = reach_of_light(scene, area, (height, width), link)
    amount = blurred(brightest / reach, max(0.6, SMOOTHING * longest / element))
    lows, highs = steps(scene.look if scene.look.tones else CEL)
    smallest = round((ISLAND * longest / element) ** 2)
    fine = refined(without_islands(amount, lows, highs, smallest), MOST if element > 1 else 1)
    shares = np.empty_like(fine)
    _shares(fine, lows, highs, 0, fine.shape[0], fine.shape[0], shares)
    faint, dark = FAINT * full + np.float32(1e-6), np.zeros(3, np.float32)
    lit = np.empty((height, width, 3), np.float32)
    _tint(light, brightest, faint, hue_of_lights(scene, link), dark, full, lit)
    whole = Band(fine.shape[1], fine.shape[0], 0, fine.shape[0])
    return np.asarray(shares[..., None] * enlarge(lit, whole), np.float32)


def toned_floor(ratio: Floats, scene: Scene) -> Floats:
    """The floor's light with the character over that without it, (h, w, 3), in two tones: light,
    and one shade for the shadow."""
    ambient = hex_linear(scene.ambient.colour) * np.float32(scene.ambient.strength)
    full = np.float32(full_light(scene))
    if full <= 0:
        return ratio
    dark = ambient / (ambient + full * hue_of_lights(scene))
    tint = hex_linear(scene.look.shade_colour)
    shade = dark + np.float32(scene.look.shade_strength) * (tint - dark)
    least = np.float32(dark.max())
    light = np.clip((brightest_of(ratio) - least) / (1 - least), 0, 1)
    fine = refined(blurred(light, 0.8), 4)
    share = np.empty_like(fine)
    look = scene.look
    width = look.softness * FLOOR_TONE
    low, high = (np.array([FLOOR_TONE + side * width], np.float32) for side in (-1, 1))
    _shares(fine, low, high, 0, fine.shape[0], fine.shape[0], share)
    return np.asarray(shade + share[..., None] * (1 - shade), np.float32)


def steps(look: Look) -> tuple[Floats, Floats]:
    """(n,) where the step to each brighter tone begins, and where it ends, linear."""
    at = np.sort(np.array(look.tones, np.float32))
    half = np.float32(look.softness / 2)
    low, high = np.maximum(at - half, 0), at + half
    return (low * low).astype(np.float32), (high * high).astype(np.float32)


def cast_steps(look: Look) -> tuple[Floats, Floats]:
    """(1,) where the step to the tone of cast shadows begins, and where it ends."""
    half = look.softness / 4
    return np.array([0.5 - half], np.float32), np.array([0.5 + half], np.float32)


def tone_shares(tones: Tones, band: Band) -> Floats:
    """(rows, W) how bright the tone of each pixel of ``band`` is: 0 is shade, 1 the brightest."""
    shares = np.empty((band.bottom - band.top, band.width), np.float32)
    _shares(tones.amount, tones.lows, tones.highs, band.top, band.bottom, band.height, shares)
    return shares


def shade_at(tones: Tones, band: Band) -> Floats:
    """(rows, W, 3) the light of the darkest tone at each pixel of ``band``; (3,) if it is the same
    everywhere."""
    if tones.cast.size <= 1:
        return tones.shade
    shares = np.empty((band.bottom - band.top, band.width, 1), np.float32)
    _shares(tones.cast, *tones.cast_steps, band.top, band.bottom, band.height, shares[..., 0])
    return np.asarray(tones.shade + shares * (tones.cast_shade - tones.shade), np.float32)


def highlight_shares(tones: Tones, band: Band) -> Floats:
    """(rows, W) how much of each pixel of ``band`` is in a highlight, 0 to 1."""
    shares = np.empty((band.bottom - band.top, band.width), np.float32)
    low, high = tones.highlight[:1], tones.highlight[1:]
    _shares(tones.shine, low, high, band.top, band.bottom, band.height, shares)
    return shares


@compiled
def _tint(
    direct: Any, brightest: Any, faint: Any, hue: Any, ambient: Any, full: Any, lit: Any
) -> None:
    """Light as bright as ``full`` in the colour of ``direct``, or in ``hue`` where that is faint,
    and ``ambient`` light."""
    for row in range(lit.shape[0]):
        for column in range(lit.shape[1]):
            share = full / (brightest[row, column] + faint)
            for c in range(3):
                lit[row, column, c] = ambient[c] + share * (direct[row, column, c] + faint * hue[c])


@compiled
def _shares(
    amount: Any, lows: Any, highs: Any, top: int, bottom: int, height: int, shares: Any
) -> None:
    width, rows, columns = shares.shape[1], amount.shape[0], amount.shape[1]
    across, down = np.float32(columns / width), np.float32(rows / height)
    before, part = places(1 / width, 0.5 / width, width, columns)
    for row in range(top, bottom):
        v = (row + 0.5) / height
        levels = levels_of_row(amount, v, 0, columns - 1)
        sides = sides_of_row(amount, v, 0, columns - 1, across, down, lows, highs)
        for column in range(width):
            side = sides[before[column]]
            shares[row - top, column] = (
                np.float32(side)
                if side >= 0
                else step_of(levels, before[column], part[column], across, down, lows, highs)
            )
