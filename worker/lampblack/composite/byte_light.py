"""The light on a row of pixels, for the compiled loop over byte layers."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compiled import compiled
from .byte_arguments import CEL, DIFFUSE, GLOSSY, LIT, FigureLight, PartLights, ToneSteps
from .samples import colour_at, level, sample
from .tones import step_share


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
    across, left, down, top = figure.place
    smooth, toned, amount, shade, tint = (
        figure.diffuse, tones.lit, tones.amount, tones.shade, tones.tint
    )  # fmt: skip
    lows, highs, strength, one = tones.lows, tones.highs, tones.strength, np.float32(1)
    cast, cast_shade, has_cast = tones.cast, tones.cast_shade, tones.cast.size > 1
    cast_low, cast_high = tones.cast_low, tones.cast_high
    v = top + row * down
    for column in columns:
        kind = kinds[worn[column]]
        if kind & DIFFUSE == 0:
            continue
        u = left + column * across
        if kind & CEL:
            tone = step_share(amount, u, v, across, down, lows, highs)
            covered = np.float32(0)
            if has_cast and tone < 1:
                covered = step_share(cast, u, v, across, down, cast_low, cast_high)
            if tone > 0:
                colour_at(toned, u, v, light, column)
                for c in range(3):
                    dark = shade[c] + covered * (cast_shade[c] - shade[c])
                    light[column, c] = dark + tone * (light[column, c] - dark)
            else:
                for c in range(3):
                    light[column, c] = shade[c] + covered * (cast_shade[c] - shade[c])
        else:
            colour_at(smooth, u, v, light, column)
            if strength > 0:
                away = one - min(max(level(amount, u, v), np.float32(0)), one)
                for c in range(3):
                    light[column, c] += strength * away * (tint[c] - light[column, c])


@compiled
def _glossy(
    row: int, columns: Any, worn: Any, kinds: Any, figure: FigureLight, tones: ToneSteps, gleam: Any
) -> None:
    across, left, down, top = figure.place
    glossy, sheen, toned, shine = figure.glossy, figure.sheen, tones.lit, tones.shine
    lows, highs = tones.shine_lows, tones.shine_highs
    v = top + row * down
    for column in columns:
        kind = kinds[worn[column]]
        if kind & GLOSSY == 0:
            continue
        u = left + column * across
        if kind & CEL:
            tone = step_share(shine, u, v, across, down, lows, highs)
            if tone > 0:
                colour_at(toned, u, v, gleam, column)
            for c in range(3):
                gleam[column, c] = gleam[column, c] * tone if tone > 0 else np.float32(0)
        elif kind & DIFFUSE:
            colour_at(sheen, u, v, gleam, column)
        else:
            colour_at(glossy, u, v, gleam, column)


@compiled
def _darken(
    row: int, columns: Any, worn: Any, kinds: Any, figure: FigureLight, light: Any, gleam: Any
) -> None:
    """Multiply by the contact shade, but for highlights in tones."""
    across, left, down, top = figure.place
    contact = figure.contact
    for column in columns:
        kind = kinds[worn[column]]
        if kind & LIT == 0:
            continue
        near = sample(contact, left + column * across, top + row * down, 0)
        for c in range(3):
            light[column, c] *= near
            if kind & CEL == 0:
                gleam[column, c] *= near


@compiled
def _add_part(
    row: int, columns: Any, worn: Any, kinds: Any, figure: FigureLight, parts: PartLights,
    part: int, light: Any, gleam: Any, spare: Any,
) -> None:  # fmt: skip
    """Add the light on a part of the character."""
    across, left, down, top = figure.place
    diffuse, glossy, owners = parts.diffuse[part], parts.glossy[part], parts.owners
    labels, layers = parts.labels[part], parts.layers[part]
    contact, has_contact, near = figure.contact, figure.has_contact, np.float32(1)
    v = top + row * down
    for column in columns:
        kind = kinds[worn[column]]
        if kind & LIT == 0 or not (labels[worn[column]] and layers[owners[row, column]]):
            continue
        u = left + column * across
        if has_contact:
            near = sample(contact, u, v, 0)
        if kind & DIFFUSE:
            colour_at(diffuse, u, v, spare, column)
            for c in range(3):
                light[column, c] += near * spare[column, c]
        if kind & GLOSSY:
            colour_at(glossy, u, v, spare, column)
            for c in range(3):
                gleam[column, c] += near * spare[column, c]
