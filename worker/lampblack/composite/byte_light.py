"""The light on a row of pixels, for the compiled loop over byte layers."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ..compiled import compiled
from .byte_arguments import CEL, DIFFUSE, GLOSSY, LIT, FigureLight, PartLights, ToneSteps
from .scan import (
    colour_of,
    colours_of_row,
    level_of,
    levels_of_row,
    places,
    sides_of_row,
    step_of,
)


class Columns(NamedTuple):
    """Where the pixels of a row are in each picture of light, see ``scan.places``."""

    diffuse: Any
    glossy: Any
    sheen: Any
    contact: Any
    amount: Any
    cast: Any
    lit: Any
    shine: Any
    part: Any


@compiled
def columns_of(count: int, figure: FigureLight, tones: ToneSteps, parts: PartLights) -> Columns:
    """The columns of rows of ``count`` pixels."""
    step, start, _, _ = figure.place
    return Columns(
        places(step, start, count, figure.diffuse.shape[1]),
        places(step, start, count, figure.glossy.shape[1]),
        places(step, start, count, figure.sheen.shape[1]),
        places(step, start, count, figure.contact.shape[1]),
        places(step, start, count, tones.amount.shape[1]),
        places(step, start, count, tones.cast.shape[1]),
        places(step, start, count, tones.lit.shape[1]),
        places(step, start, count, tones.shine.shape[1]),
        places(step, start, count, parts.diffuse.shape[2]),
    )


@compiled
def light_row(
    row: int, columns: Any, at: Columns, worn: Any, kinds: Any,
    figure: FigureLight, tones: ToneSteps, parts: PartLights, light: Any, gleam: Any, spare: Any,
) -> None:  # fmt: skip
    """Write the diffuse and the glossy light on ``columns`` of a row to ``light`` and ``gleam``,
    (W, 3) scene-linear. What paint does not need is not written.

    Args:
        at: where all columns are. worn: (W,) the label of the paint of each pixel.
        kinds: by label.
        spare: (W, 3), overwritten.
    """
    if len(columns) == 0:
        return
    _diffuse(row, columns, at, worn, kinds, figure, tones, light)
    _glossy(row, columns, at, worn, kinds, figure, tones, gleam)
    if figure.has_contact:
        _darken(row, columns, at, worn, kinds, figure, light, gleam)
    for part in range(parts.number):
        _add_part(row, columns, at, worn, kinds, figure, parts, part, light, gleam, spare)


@compiled
def _diffuse(
    row: int, columns: Any, at: Columns, worn: Any, kinds: Any, figure: FigureLight,
    tones: ToneSteps, light: Any,
) -> None:  # fmt: skip
    across, _, down, top = figure.place
    amount, cast, shade, tint = tones.amount, tones.cast, tones.shade, tones.tint
    lows, highs, strength, one = tones.lows, tones.highs, tones.strength, np.float32(1)
    cast_shade, has_cast = tones.cast_shade, tones.cast.size > 1
    cast_low, cast_high = tones.cast_low, tones.cast_high
    v, left, right = top + row * down, columns[0], columns[-1]
    smooth_at, smooth_share = at.diffuse
    toned_at, toned_share = at.lit
    amount_at, amount_share = at.amount
    cast_at, cast_share = at.cast
    smooth_row = colours_of_row(figure.diffuse, v, smooth_at[left], smooth_at[right])
    toned_row = colours_of_row(tones.lit, v, toned_at[left], toned_at[right])
    wide, high = np.float32(amount.shape[1] * across), np.float32(amount.shape[0] * down)
    cast_across, cast_down = np.float32(cast.shape[1] * across), np.float32(cast.shape[0] * down)
    first, last = amount_at[left], amount_at[right]
    amounts = levels_of_row(amount, v, first, last)
    sides = sides_of_row(amount, v, first, last, wide, high, lows, highs)
    first, last = cast_at[left], cast_at[right]
    casts = levels_of_row(cast, v, first, last)
    cast_sides = sides_of_row(cast, v, first, last, cast_across, cast_down, cast_low, cast_high)
    for column in columns:
        kind = kinds[worn[column]]
        if kind & DIFFUSE == 0:
            continue
        if kind & CEL == 0:
            colour_of(smooth_row, smooth_at[column], smooth_share[column], light, column)
            if strength > 0:
                lit = level_of(amounts, amount_at[column], amount_share[column])
                away = one - min(max(lit, np.float32(0)), one)
                for c in range(3):
                    light[column, c] += strength * away * (tint[c] - light[column, c])
            continue
        side = sides[amount_at[column]]
        if side == 1:
            colour_of(toned_row, toned_at[column], toned_share[column], light, column)
            continue
        tone, covered = np.float32(0), np.float32(0)
        if side < 0:
            here, share = amount_at[column], amount_share[column]
            tone = step_of(amounts, here, share, wide, high, lows, highs)
        if has_cast and tone < 1:
            here, share = cast_at[column], cast_share[column]
            covered = np.float32(cast_sides[here])
            if covered < 0:
                covered = step_of(casts, here, share, cast_across, cast_down, cast_low, cast_high)
        if tone > 0:
            colour_of(toned_row, toned_at[column], toned_share[column], light, column)
            for c in range(3):
                dark = shade[c] + covered * (cast_shade[c] - shade[c])
                light[column, c] = dark + tone * (light[column, c] - dark)
        else:
            for c in range(3):
                light[column, c] = shade[c] + covered * (cast_shade[c] - shade[c])


@compiled
def _glossy(
    row: int, columns: Any, at: Columns, worn: Any, kinds: Any, figure: FigureLight,
    tones: ToneSteps, gleam: Any,
) -> None:  # fmt: skip
    across, _, down, top = figure.place
    shine, lows, highs = tones.shine, tones.shine_lows, tones.shine_highs
    v, left, right = top + row * down, columns[0], columns[-1]
    glossy_at, glossy_share = at.glossy
    sheen_at, sheen_share = at.sheen
    toned_at, toned_share = at.lit
    shine_at, shine_share = at.shine
    glossy_row = colours_of_row(figure.glossy, v, glossy_at[left], glossy_at[right])
    sheen_row = colours_of_row(figure.sheen, v, sheen_at[left], sheen_at[right])
    toned_last = toned_at[right] if shine.size > 1 else toned_at[left]
    toned_row = colours_of_row(tones.lit, v, toned_at[left], toned_last)
    wide, high = np.float32(shine.shape[1] * across), np.float32(shine.shape[0] * down)
    first, last = shine_at[left], shine_at[right]
    shines = levels_of_row(shine, v, first, last)
    sides = sides_of_row(shine, v, first, last, wide, high, lows, highs)
    for column in columns:
        kind = kinds[worn[column]]
        if kind & GLOSSY == 0:
            continue
        if kind & CEL:
            here, share = shine_at[column], shine_share[column]
            tone = np.float32(sides[here])
            if tone < 0:
                tone = step_of(shines, here, share, wide, high, lows, highs)
            if tone > 0:
                colour_of(toned_row, toned_at[column], toned_share[column], gleam, column)
            for c in range(3):
                gleam[column, c] = gleam[column, c] * tone if tone > 0 else np.float32(0)
        elif kind & DIFFUSE:
            colour_of(sheen_row, sheen_at[column], sheen_share[column], gleam, column)
        else:
            colour_of(glossy_row, glossy_at[column], glossy_share[column], gleam, column)


@compiled
def _darken(
    row: int, columns: Any, at: Columns, worn: Any, kinds: Any, figure: FigureLight,
    light: Any, gleam: Any,
) -> None:  # fmt: skip
    """Multiply by the contact shade, but for highlights in tones."""
    _, _, down, top = figure.place
    before, share = at.contact
    first, last = before[columns[0]], before[columns[-1]]
    nearness = levels_of_row(figure.contact, top + row * down, first, last)
    for column in columns:
        kind = kinds[worn[column]]
        if kind & LIT == 0:
            continue
        near = level_of(nearness, before[column], share[column])
        for c in range(3):
            light[column, c] *= near
        if kind & GLOSSY and kind & CEL == 0:
            for c in range(3):
                gleam[column, c] *= near


@compiled
def _add_part(
    row: int, columns: Any, at: Columns, worn: Any, kinds: Any, figure: FigureLight,
    parts: PartLights, part: int, light: Any, gleam: Any, spare: Any,
) -> None:  # fmt: skip
    """Add the light on a part of the character."""
    _, _, down, top = figure.place
    owners, labels, layers = parts.owners, parts.labels[part], parts.layers[part]
    contact, has_contact, near = figure.contact, figure.has_contact, np.float32(1)
    v, left, right = top + row * down, columns[0], columns[-1]
    before, share = at.part
    contact_at, contact_share = at.contact
    diffuse_row = colours_of_row(parts.diffuse[part], v, before[left], before[right])
    glossy_row = colours_of_row(parts.glossy[part], v, before[left], before[right])
    nearness = levels_of_row(contact, v, contact_at[left], contact_at[right])
    for column in columns:
        kind = kinds[worn[column]]
        if kind & LIT == 0 or not (labels[worn[column]] and layers[owners[row, column]]):
            continue
        if has_contact:
            near = level_of(nearness, contact_at[column], contact_share[column])
        if kind & DIFFUSE:
            colour_of(diffuse_row, before[column], share[column], spare, column)
            for c in range(3):
                light[column, c] += near * spare[column, c]
        if kind & GLOSSY:
            colour_of(glossy_row, before[column], share[column], spare, column)
            for c in range(3):
                gleam[column, c] += near * spare[column, c]
