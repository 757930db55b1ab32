"""The compiled loop over the pixels of byte layers: row by row, in stages."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compiled import compiled
from .byte_arguments import (
    DIFFUSE,
    LIT,
    FigureLight,
    Ground,
    Paints,
    PartLights,
    Planes,
    RimBand,
    ToneSteps,
)
from .byte_ground import put_on_ground
from .byte_light import columns_of, light_row
from .byte_paint import reflect_row
from .line import OWN_COLOUR
from .rim import PLAIN_RIM, rim_reach, rim_share
from .roll_off import KNEE, PALING
from .samples import encode, paleness_of


@compiled
def light_pixels(
    planes: Planes, paints: Paints, figure: FigureLight, tones: ToneSteps, parts: PartLights,
    rim: RimBand, ground: Ground, ink_light: Any, tables: Any, rows: tuple[int, int], lit: Any,
) -> None:  # fmt: skip
    """Write the lit pixels to ``lit``, (H, W, 4) uint8 sRGB, premultiplied.

    Tuples of arrays are unpacked once a row: to unpack them costs as much as a pixel.

    Args:
        ink_light: how far the line takes light, 0 to 1.
        tables: see ``samples``: from sRGB bytes to light, and back.
        rows: the first row to write, and how many there are from one to the next.
    """
    height, width = lit.shape[0], lit.shape[1]
    base, fill = np.empty((width, 3), np.float32), np.empty((width, 3), np.float32)
    unlit, spare = np.empty((width, 3), np.float32), np.empty((width, 3), np.float32)
    light, gleam = np.empty((2, width, 3), np.float32), np.empty((2, width, 3), np.float32)
    columns, mixed = np.empty(width, np.intp), np.empty(width, np.intp)
    at = columns_of(width, figure, tones, parts)
    for row in range(rows[0], height, rows[1]):
        found, both = _chosen(row, planes, paints, parts, tables, base, fill, unlit, columns, mixed)
        own, their = columns[:found], mixed[:both]
        light_row(
            row, own, at, planes.labels[row], paints.kinds, figure, tones, parts,
            light[0], gleam[0], spare,
        )  # fmt: skip
        light_row(
            row, their, at, planes.others[row], paints.kinds, figure, tones, parts,
            light[1], gleam[1], spare,
        )  # fmt: skip
        reflect_row(row, own, planes, paints, parts.number, light, gleam, base, fill, unlit)
        _roll_off(own, base, fill)
        if rim.shown:
            _add_rim(row, own, planes.labels, paints.kinds, base, rim, fill)
        _lay_ink(row, own, planes, paints.kinds, light[0], ink_light, tables, fill, unlit)
        put_on_ground(row, fill, planes, ground, tables, lit)


@compiled
def _chosen(
    row: int, planes: Planes, paints: Paints, parts: PartLights, tables: Any,
    base: Any, fill: Any, unlit: Any, columns: Any, mixed: Any,
) -> tuple[int, int]:  # fmt: skip
    """Begin a row: the drawn colours to ``base`` and ``unlit``, both (W, 3) scene-linear, and the
    columns of pixels that have light, and of those whose second colour has a light of its own;
    returns their numbers."""
    albedo, coverage, labels = planes.albedo, planes.coverage, planes.labels
    others, shares, kinds, linked = planes.others, planes.shares, paints.kinds, parts.number > 0
    to_linear = tables[0]
    found, both = 0, 0
    for column in range(len(base)):
        if coverage[row, column] == 0:
            continue
        for c in range(3):
            base[column, c] = to_linear[albedo[row, column, c]]
            fill[column, c], unlit[column, c] = np.float32(0), base[column, c]
        kind, mate = kinds[labels[row, column]], kinds[others[row, column]]
        columns[found] = column
        found += 1
        if shares[row, column] > 0 and (mate != kind or linked):
            mixed[both] = column
            both += 1
    return found, both


@compiled
def _roll_off(columns: Any, base: Any, fill: Any) -> None:
    """See ``roll_off``; ``base`` is the drawn colour."""
    one, least = np.float32(1), np.float32(KNEE)
    for column in columns:
        peak = max(max(fill[column, 0], fill[column, 1]), fill[column, 2])
        if peak <= least:
            continue
        drawn = max(max(base[column, 0], base[column, 1]), base[column, 2])
        knee = min(max(drawn, least), one)
        if peak > knee:
            room, over = max(one - knee, np.float32(1e-4)), peak - knee
            bent = knee + room * over / (room + over)
            scale = bent / peak
            pale = over * over / (over * over + np.float32(PALING * PALING))
            for c in range(3):
                fill[column, c] = fill[column, c] * scale + pale * (bent - fill[column, c] * scale)


@compiled
def _add_rim(
    row: int, columns: Any, labels: Any, kinds: Any, base: Any, rim: RimBand, fill: Any
) -> None:
    edges, colour, plain, one = rim.edges, rim.colour, np.float32(PLAIN_RIM), np.float32(1)
    unit, width, pixel, strength, away = rim.unit, rim.width, rim.pixel, rim.strength, rim.away
    widest = rim_reach(unit, width, pixel)
    for column in columns:
        if edges[row, column] >= widest or kinds[labels[row, column]] & LIT == 0:
            continue
        edge = rim_share(
            edges, row, column, unit, width, pixel, strength, away,
            rim.key[0] - (column + 0.5) * rim.step[0], rim.key[1] - (row + 0.5) * rim.step[1],
        )  # fmt: skip
        if edge > 0:
            for c in range(3):
                aim = colour[c] * (plain + (one - plain) * np.sqrt(base[column, c]))
                fill[column, c] += edge * max(aim - fill[column, c], np.float32(0))


@compiled
def _lay_ink(
    row: int, columns: Any, planes: Planes, kinds: Any, light: Any, ink_light: Any, tables: Any,
    fill: Any, unlit: Any,
) -> None:  # fmt: skip
    """Make ``fill`` and ``unlit``, scene-linear, the colour of fill and line together, sRGB; see
    ``lit_line``."""
    to_linear, to_srgb = tables
    ink, ink_colour, labels = planes.ink, planes.ink_colour, planes.labels
    byte, one = np.float32(1 / 255), np.float32(1)
    taken = ink_light * np.float32(OWN_COLOUR)
    for column in columns:
        if ink[row, column] == 0:
            for c in range(3):
                fill[column, c] = encode(to_srgb, fill[column, c] + unlit[column, c])
            continue
        line, pale = ink[row, column] * byte, np.float32(0)
        if kinds[labels[row, column]] & DIFFUSE:
            pale = max(paleness_of(ink_colour[row, column]), ink_light)
        for c in range(3):
            shown = fill[column, c] + unlit[column, c]
            own = ink_colour[row, column, c] * byte
            if pale > 0:
                dark = to_linear[ink_colour[row, column, c]]
                dark *= one + pale * (min(light[column, c], one) - one)
                own = encode(to_srgb, dark + taken * shown)
            colour = encode(to_srgb, shown)
            fill[column, c] = colour + line * (own - colour)
