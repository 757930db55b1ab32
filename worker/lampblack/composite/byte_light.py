"""The light on a row of pixels, for the compiled loop over byte layers."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compiled import compiled
from .byte_arguments import CEL, DIFFUSE, GLOSSY, LIT, FigureLight, PartLights, ToneSteps
from .scan import colour_of, colours_of_row, level_of, levels_of_row, step_of


@compiled
def light_row(
    row: int, columns: Any, worn: Any, kinds: Any,
    figure: FigureLight, tones: ToneSteps, parts: PartLights, light: Any, gleam: Any, spare: Any,
) -> None:  # fmt: skip
    """Write the diffuse and the glossy light on ``columns`` of a row to ``light`` and ``gleam``,
    (W, 3) scene-linear. What paint does not need is not written.

    Args:
        worn: (W,) the label of the paint of each pixel. kinds: by label.
        spare: (W, 3), overwritten.
    """
    if len(columns) == 0:
        return
    _diffuse(row, columns, worn, kinds, figure, tones, light)
    _glossy(row, columns, worn, kinds, figure, tones, gleam)
    if figure.has_contact:
        _darken(row, columns, worn, kinds, figure, light, gleam)
    for part in range(parts.number):
        _add_part(row, columns, worn, kinds, figure, parts, part, light, gleam, spare)


@compiled
def _diffuse(
    row: int, columns: Any, worn: Any, kinds: Any, figure: FigureLight, tones: ToneSteps, light: Any
) -> None:
    across, left, down, _ = figure.place
    smooth, toned, amount, shade, tint = (
        figure.diffuse, tones.lit, tones.amount, tones.shade, tones.tint
    )  # fmt: skip
    lows, highs, strength, one = tones.lows, tones.highs, tones.strength, np.float32(1)
    cast, cast_shade, has_cast = tones.cast, tones.cast_shade, tones.cast.size > 1
    cast_low, cast_high = tones.cast_low, tones.cast_high
    begin, end, v = _extent(columns, figure.place, row)
    smooth_row = colours_of_row(smooth, v, begin, end)
    toned_row = colours_of_row(toned, v, begin, end)
    amounts = levels_of_row(amount, v, begin, end)
    casts = levels_of_row(cast, v, begin, end)
    wide, high = np.float32(amount.shape[1] * across), np.float32(amount.shape[0] * down)
    cast_across, cast_down = np.float32(cast.shape[1] * across), np.float32(cast.shape[0] * down)
    for column in columns:
        kind = kinds[worn[column]]
        if kind & DIFFUSE == 0:
            continue
        u = left + column * across
        if kind & CEL:
            tone = step_of(amounts, u, wide, high, lows, highs)
            covered = np.float32(0)
            if has_cast and tone < 1:
                covered = step_of(casts, u, cast_across, cast_down, cast_low, cast_high)
            if tone > 0:
                colour_of(toned_row, u, light, column)
                for c in range(3):
                    dark = shade[c] + covered * (cast_shade[c] - shade[c])
                    light[column, c] = dark + tone * (light[column, c] - dark)
            else:
                for c in range(3):
                    light[column, c] = shade[c] + covered * (cast_shade[c] - shade[c])
        else:
            colour_of(smooth_row, u, light, column)
            if strength > 0:
                away = one - min(max(level_of(amounts, u), np.float32(0)), one)
                for c in range(3):
                    light[column, c] += strength * away * (tint[c] - light[column, c])


@compiled
def _extent(columns: Any, place: Any, row: int) -> tuple[float, float, float]:
    """Where ``columns`` begin and end in the light on the character, and ``row`` is in it."""
    across, left, down, top = place
    return left + columns[0] * across, left + columns[-1] * across, top + row * down


@compiled
def _glossy(
    row: int, columns: Any, worn: Any, kinds: Any, figure: FigureLight, tones: ToneSteps, gleam: Any
) -> None:
    across, left, down, _ = figure.place
    glossy, sheen, toned, shine = figure.glossy, figure.sheen, tones.lit, tones.shine
    lows, highs = tones.shine_lows, tones.shine_highs
    begin, end, v = _extent(columns, figure.place, row)
    glossy_row = colours_of_row(glossy, v, begin, end)
    sheen_row = colours_of_row(sheen, v, begin, end)
    toned_row = colours_of_row(toned, v, begin, end if shine.size > 1 else begin)
    shines = levels_of_row(shine, v, begin, end)
    wide, high = np.float32(shine.shape[1] * across), np.float32(shine.shape[0] * down)
    for column in columns:
        kind = kinds[worn[column]]
        if kind & GLOSSY == 0:
            continue
        u = left + column * across
        if kind & CEL:
            tone = step_of(shines, u, wide, high, lows, highs)
            if tone > 0:
                colour_of(toned_row, u, gleam, column)
            for c in range(3):
                gleam[column, c] = gleam[column, c] * tone if tone > 0 else np.float32(0)
        elif kind & DIFFUSE:
            colour_of(sheen_row, u, gleam, column)
        else:
            colour_of(glossy_row, u, gleam, column)


@compiled
def _darken(
    row: int, columns: Any, worn: Any, kinds: Any, figure: FigureLight, light: Any, gleam: Any
) -> None:
    """Multiply by the contact shade, but for highlights in tones."""
    across, left, _, _ = figure.place
    contact = figure.contact
    begin, end, v = _extent(columns, figure.place, row)
    nearness = levels_of_row(contact, v, begin, end)
    for column in columns:
        kind = kinds[worn[column]]
        if kind & LIT == 0:
            continue
        near = level_of(nearness, left + column * across)
        for c in range(3):
            light[column, c] *= near
        if kind & GLOSSY and kind & CEL == 0:
            for c in range(3):
                gleam[column, c] *= near


@compiled
def _add_part(
    row: int, columns: Any, worn: Any, kinds: Any, figure: FigureLight, parts: PartLights,
    part: int, light: Any, gleam: Any, spare: Any,
) -> None:  # fmt: skip
    """Add the light on a part of the character."""
    across, left, _, _ = figure.place
    diffuse, glossy, owners = parts.diffuse[part], parts.glossy[part], parts.owners
    labels, layers = parts.labels[part], parts.layers[part]
    contact, has_contact, near = figure.contact, figure.has_contact, np.float32(1)
    begin, end, v = _extent(columns, figure.place, row)
    diffuse_row = colours_of_row(diffuse, v, begin, end)
    glossy_row = colours_of_row(glossy, v, begin, end)
    nearness = levels_of_row(contact, v, begin, end)
    for column in columns:
        kind = kinds[worn[column]]
        if kind & LIT == 0 or not (labels[worn[column]] and layers[owners[row, column]]):
            continue
        u = left + column * across
        if has_contact:
            near = level_of(nearness, u)
        if kind & DIFFUSE:
            colour_of(diffuse_row, u, spare, column)
            for c in range(3):
                light[column, c] += near * spare[column, c]
        if kind & GLOSSY:
            colour_of(glossy_row, u, spare, column)
            for c in range(3):
                gleam[column, c] += near * spare[column, c]
