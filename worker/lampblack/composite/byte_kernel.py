"""The composite of byte layers, for previews: the same computation in one compiled loop."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..compiled import compiled
from ..drawing.palette import Palette
from ..materials import MaterialTable
from ..scene import Scene, default_scene
from .bloom import bloom_of
from .borders import swatch_albedos
from .byte_layers import ByteLayers
from .float_kernel import ROUNDING
from .illumination import Illumination
from .line import OWN_COLOUR
from .resample import Band, Box, enlarge
from .rim import PLAIN_RIM, RimLight, rim_reach, rim_share
from .roll_off import KNEE, PALING
from .samples import LINEAR, SRGB, encode, level, paleness_of, sample
from .shading import Shading
from .tones import Tones, step_reach, step_share

Floats = NDArray[np.float32]

_DIFFUSE, _GLOSSY, _BOTH, _CEL = np.uint8(1), np.uint8(2), np.uint8(3), np.uint8(4)
_GLOW = np.uint8(8)
_UNIT = np.ones((1, 1, 3), np.float32)
_UNSHADED = np.ones((1, 1), np.bool_)


def composite_bytes(
    layers: ByteLayers, illumination: Illumination, scene: Scene, crop: Box
) -> NDArray[np.uint8]:
    """The layers, lit: (H, W, 4) uint8 sRGB, premultiplied; see ``composite``.

    Args:
        layers: cut from a drawing.
        crop: the part of the drawing that they show, in its pixels.
    """
    materials = MaterialTable.of(scene, layers.palette.colours)
    kinds = materials.diffuse * _DIFFUSE + materials.glossy * _GLOSSY
    kinds += np.where(kinds > 0, materials.cel * _CEL, np.uint8(0))
    kinds += (materials.emission > 0) * _GLOW
    height, width = layers.ink.shape
    area = illumination.character_area or crop
    pixel = max(crop[2] / width, crop[3] / height)
    shading = Shading.of(illumination, scene, materials, pixel, area)
    lit = np.empty((height, width, 4), np.uint8)
    ratio, contact = shading.floor_ratio, shading.contact
    smooth = kinds & _CEL == 0
    _light(
        layers.pixels, layers.albedo, layers.ink, layers.ink_colour, layers.coverage,
        layers.labels, layers.others, layers.shares,
        swatch_albedos(layers.palette), kinds, materials.gloss, materials.emission,
        illumination.diffuse if (smooth & (kinds & _DIFFUSE > 0)).any() else _UNIT,
        illumination.glossy if (smooth & (kinds & _BOTH == _GLOSSY)).any() else _UNIT,
        illumination.sheen if (smooth & (kinds & _BOTH == _BOTH)).any() else _UNIT,
        _steps(crop, layers.size, area), _tone_arguments(shading.tones),
        _part_arguments(shading, layers),
        contact is not None, _UNIT if contact is None else contact,
        _rim_arguments(shading.rim, layers, crop), np.float32(shading.ink_light),
        _UNIT if ratio is None else ratio,
        _UNSHADED if ratio is None else _unshaded(ratio), ratio is not None,
        _steps(crop, layers.size, illumination.floor_area or crop),
        LINEAR, SRGB, lit,
    )  # fmt: skip
    bloom = bloom_of(layers, materials, scene, pixel)
    if bloom is not None:
        shown = bloom.over(lit.astype(np.float32) / 255, Band(width, height, 0, height))
        lit = np.rint(shown * 255).astype(np.uint8)
    return lit


def _tone_arguments(tones: Tones | None) -> tuple[Any, ...]:
    if tones is None:
        none = np.zeros(1, np.float32)
        return (
            _UNIT[..., 0], _UNIT[..., 0], _UNIT, _UNIT[0, 0], none, none, none, none,
            _UNIT[0, 0], np.float32(0),
        )  # fmt: skip
    return (
        tones.amount, tones.shine, tones.lit, tones.shade, tones.lows, tones.highs,
        tones.highlight[:1], tones.highlight[1:], tones.tint, tones.strength,
    )  # fmt: skip


def _part_arguments(shading: Shading, layers: ByteLayers) -> tuple[Any, ...]:
    """Light on parts of the character: their number, diffuse and glossy light, which labels and
    which layers each reaches, and the layer of each pixel."""
    parts = shading.parts
    if not parts:
        none = np.zeros((1, 1), np.bool_)
        return 0, _UNIT[None], _UNIT[None], none, none, np.zeros((1, 1), np.int8)
    owners = layers.owners
    if owners is None:
        owners = np.full(layers.labels.shape, -1, np.int8)
    size = max((light.shape for _, light, _ in parts), key=lambda shape: shape[0] * shape[1])
    band = Band(size[1], size[0], 0, size[0])
    return (
        len(parts),
        np.stack([enlarge(light, band) for _, light, _ in parts]),
        np.stack([enlarge(light, band) for _, _, light in parts]),
        np.stack([link.labels(layers.palette) for link, _, _ in parts]),
        np.stack([link.owners(layers.layers) for link, _, _ in parts]),
        owners,
    )


def _rim_arguments(rim: RimLight | None, layers: ByteLayers, crop: Box) -> tuple[Any, ...]:
    edges = layers.edges
    if rim is None or edges is None:
        return False, layers.ink, (0.0,) * 5, (0.0, 0.0, 1.0, 1.0), _UNIT[0, 0]
    across, down = crop[2] / layers.size[0], crop[3] / layers.size[1]
    sizes = layers.edge_unit, rim.width, max(across, down), rim.strength, rim.away
    key = rim.key[0] - crop[0], rim.key[1] - crop[1], across, down
    return True, edges, sizes, key, rim.colour


def _unshaded(floor: Floats) -> NDArray[np.bool_]:
    """(h, w) bool: no pixel of the drawing in this element is in shadow."""
    clear = (np.abs(floor - 1) < 1e-3).all(axis=2)
    return np.asarray(ndimage.minimum_filter(clear, 3, mode="nearest"))


def warm_up() -> None:
    """Load the compiled loop, or compile it."""
    grey, bytes_ = np.zeros((1, 1, 3), np.uint8), np.zeros((1, 1), np.uint8)
    label = np.full((1, 1), -1, np.int16)
    pixels, palette = np.zeros((1, 1, 4), np.uint8), Palette(())
    layers = ByteLayers(pixels, grey, bytes_, grey, bytes_, label, label, bytes_, palette)
    white = np.ones(3, np.float32), _UNIT, _UNIT
    composite_bytes(layers, Illumination([white], floor=[white]), default_scene(1, 1), (0, 0, 1, 1))


def _steps(crop: Box, size: tuple[int, int], area: Box) -> tuple[float, float, float, float]:
    """(step, start) along x, then along y: pixel ``i`` of the layers is at ``start + i * step`` of
    ``area``, which extends from 0 to 1."""
    found = []
    for axis in (0, 1):
        step = crop[axis + 2] / size[axis] / area[axis + 2]
        found += [step, (crop[axis] - area[axis]) / area[axis + 2] + step / 2]
    return found[0], found[1], found[2], found[3]


@compiled
def _light(
    pixels: Any, albedo: Any, ink: Any, ink_colour: Any, coverage: Any,
    labels: Any, others: Any, shares: Any,
    swatches: Any, kinds: Any, gloss: Any, emission: Any,
    diffuse: Any, glossy: Any, sheen: Any, on_figure: Any,
    tones: Any, linked: Any, has_contact: bool, contact: Any, rim_light: Any, ink_light: Any,
    floor: Any, unshaded: Any, has_floor: bool, on_ground: Any,
    to_linear: Any, to_srgb: Any, lit: Any,
) -> None:  # fmt: skip
    amount, shine, toned, shade, lows, highs = tones[:6]
    shine_lows, shine_highs, tint, tint_strength = tones[6:]
    across_px, down_px = on_figure[0], on_figure[2]
    has_rim, edges, rim, key, rim_colour = rim_light
    parts, part_light, part_shine, reached, reached_layers, owners = linked
    lowest, highest = lows[0], highs[-1]
    reach = np.float32(step_reach(amount, across_px, down_px))
    widest = rim_reach(rim[0], rim[1], rim[2]) if has_rim else 0.0
    simple = parts == 0 and not has_contact
    plain_kind = 1 if tint_strength == 0 else 5
    byte, one, zero = np.float32(1 / 255), np.float32(1), np.float32(0)
    colourless, taken = np.float32(PLAIN_RIM), np.float32(OWN_COLOUR)
    fill, shown = np.zeros(3, np.float32), np.zeros(3, np.float32)
    unlit, light, gleam = np.zeros(3, np.float32), np.zeros(3, np.float32), np.zeros(3, np.float32)
    for row in range(ink.shape[0]):
        for column in range(ink.shape[1]):
            alpha = pixels[row, column, 3] * byte
            cover = coverage[row, column] * byte
            # Line art without fill is lit on white paper, which is removed again below.
            paper = cover - alpha if cover - alpha > np.float32(ROUNDING) else zero
            behind = alpha + paper - cover
            across, down = on_ground[1] + column * on_ground[0], on_ground[3] + row * on_ground[2]
            shaded = (
                has_floor
                and not unshaded[
                    min(max(int(down * unshaded.shape[0]), 0), unshaded.shape[0] - 1),
                    min(max(int(across * unshaded.shape[1]), 0), unshaded.shape[1] - 1),
                ]
            )
            if cover == 0 and not shaded:
                for c in range(4):
                    lit[row, column, c] = pixels[row, column, c]
                continue
            label, other = labels[row, column], others[row, column]
            share = shares[row, column] * byte
            peak, drawn_peak = zero, zero
            u, v = on_figure[1] + column * on_figure[0], on_figure[3] + row * on_figure[2]
            for c in range(3):
                fill[c], unlit[c] = zero, to_linear[albedo[row, column, c]]
                drawn_peak = max(drawn_peak, unlit[c])
            touched = cover > 0 and (kinds[label] != 0 or kinds[other] != 0)
            if (
                touched
                and simple
                and share == 0
                and (kinds[label] == 5 or kinds[label] == plain_kind)
            ):
                # Most pixels: paint of one diffuse colour. The light is sampled once for all three
                # channels.
                tone, cel = one, kinds[label] & 4 != 0
                if cel:
                    # Most of them are far from any step too.
                    x = min(max(u * amount.shape[1] - 0.5, 0.0), amount.shape[1] - 1.0)
                    y = min(max(v * amount.shape[0] - 0.5, 0.0), amount.shape[0] - 1.0)
                    x0, y0 = int(x), int(y)
                    x1, y1 = min(x0 + 1, amount.shape[1] - 1), min(y0 + 1, amount.shape[0] - 1)
                    least = min(amount[y0, x0], amount[y0, x1], amount[y1, x0], amount[y1, x1])
                    most = max(amount[y0, x0], amount[y0, x1], amount[y1, x0], amount[y1, x1])
                    if most + reach * (most - least) < lowest:
                        tone = zero
                    elif least - reach * (most - least) < highest:
                        tone = step_share(amount, u, v, across_px, down_px, lows, highs)
                height = toned.shape[0] if cel else diffuse.shape[0]
                width = toned.shape[1] if cel else diffuse.shape[1]
                x = min(max(u * width - 0.5, 0.0), width - 1.0)
                y = min(max(v * height - 0.5, 0.0), height - 1.0)
                x0, y0 = int(x), int(y)
                x1, y1 = min(x0 + 1, width - 1), min(y0 + 1, height - 1)
                s, t = np.float32(x - x0), np.float32(y - y0)
                for c in range(3):
                    if cel and tone == 0:
                        light[c] = shade[c]
                    elif cel:
                        above = toned[y0, x0, c] + s * (toned[y0, x1, c] - toned[y0, x0, c])
                        below = toned[y1, x0, c] + s * (toned[y1, x1, c] - toned[y1, x0, c])
                        light[c] = shade[c] + tone * (above + t * (below - above) - shade[c])
                    else:
                        above = diffuse[y0, x0, c] + s * (diffuse[y0, x1, c] - diffuse[y0, x0, c])
                        below = diffuse[y1, x0, c] + s * (diffuse[y1, x1, c] - diffuse[y1, x0, c])
                        light[c] = above + t * (below - above)
                    fill[c] = unlit[c] * light[c]
                    unlit[c] = zero
                    peak = max(peak, fill[c])
            elif touched:
                near = sample(contact, u, v, 0) if has_contact else one
                for second in range(2 if share > 0 else 1):
                    worn = other if second else label
                    kind = kinds[worn]
                    if kind & 1:
                        if kind & 4:
                            tone = step_share(amount, u, v, across_px, down_px, lows, highs)
                            for c in range(3):
                                light[c] = shade[c]
                                if tone > 0:
                                    light[c] += tone * (sample(toned, u, v, c) - shade[c])
                        else:
                            for c in range(3):
                                light[c] = sample(diffuse, u, v, c)
                            if tint_strength > 0:
                                dark = one - min(max(level(amount, u, v), zero), one)
                                for c in range(3):
                                    light[c] += tint_strength * dark * (tint[c] - light[c])
                        for link in range(parts):
                            if reached[link, worn] and reached_layers[link, owners[row, column]]:
                                for c in range(3):
                                    light[c] += sample(part_light[link], u, v, c)
                        if has_contact:
                            for c in range(3):
                                light[c] *= near
                    if kind & 2:
                        if kind & 4:
                            tone = step_share(
                                shine, u, v, across_px, down_px, shine_lows, shine_highs
                            )
                            for c in range(3):
                                gleam[c] = sample(toned, u, v, c)
                        else:
                            for c in range(3):
                                if kind & 1:
                                    gleam[c] = sample(sheen, u, v, c)
                                else:
                                    gleam[c] = sample(glossy, u, v, c)
                            tone = near
                        for c in range(3):
                            gleam[c] *= tone
                        for link in range(parts):
                            if reached[link, worn] and reached_layers[link, owners[row, column]]:
                                for c in range(3):
                                    gleam[c] += near * sample(part_shine[link], u, v, c)
                    for c in range(3):
                        base = to_linear[albedo[row, column, c]]
                        theirs = min(base, share * swatches[other, c])
                        paint = theirs if second else base - theirs
                        if not second:
                            unlit[c] = zero
                        if kind & 11 == 0:
                            unlit[c] += paint
                        if kind & 8:
                            fill[c] += paint * emission[worn]
                            if kind & 3 == 0:
                                fill[c] += paint
                        if kind & 1:
                            fill[c] += paint * light[c]
                        if kind & 2:
                            part = share if second else one - share
                            fill[c] += gloss[worn] * gleam[c] * (part if kind & 1 else paint)
                for c in range(3):
                    peak = max(peak, fill[c])
            knee = min(max(drawn_peak, np.float32(KNEE)), one)
            if peak > knee:
                room, over = max(one - knee, np.float32(1e-4)), peak - knee
                bent = knee + room * over / (room + over)
                scale = bent / max(peak, np.float32(KNEE))
                pale = over * over / (over * over + np.float32(PALING * PALING))
                for c in range(3):
                    fill[c] = fill[c] * scale + pale * (bent - fill[c] * scale)
            if has_rim and touched and edges[row, column] < widest and kinds[label] & 3:
                edge = rim_share(
                    edges, row, column, rim[0], rim[1], rim[2], rim[3], rim[4],
                    key[0] - (column + 0.5) * key[2], key[1] - (row + 0.5) * key[3],
                )  # fmt: skip
                if edge > 0:
                    for c in range(3):
                        base = to_linear[albedo[row, column, c]]
                        aim = rim_colour[c] * (colourless + (one - colourless) * np.sqrt(base))
                        fill[c] += edge * max(aim - fill[c], zero)
            line = ink[row, column] * byte
            pale = zero
            if line > 0 and touched and kinds[label] & 1:
                pale = max(paleness_of(ink_colour[row, column]), ink_light)
                if share > 0 and (parts > 0 or kinds[label] != kinds[other]):
                    if kinds[label] & 4:
                        tone = step_share(amount, u, v, across_px, down_px, lows, highs)
                    for c in range(3):
                        if kinds[label] & 4:
                            light[c] = shade[c] + tone * (sample(toned, u, v, c) - shade[c])
                        else:
                            light[c] = sample(diffuse, u, v, c)
                        for link in range(parts):
                            if reached[link, label] and reached_layers[link, owners[row, column]]:
                                light[c] += sample(part_light[link], u, v, c)
                        light[c] *= near
            ground_alpha = behind
            darkest = one
            for c in range(3):
                tone = ink_colour[row, column, c] * byte
                drawn = albedo[row, column, c] * byte
                drawn += line * (tone - drawn)
                shown_fill = fill[c] + unlit[c]
                colour = encode(to_srgb, shown_fill)
                if pale > 0:
                    tone = to_linear[ink_colour[row, column, c]]
                    tone *= one + pale * (min(light[c], one) - one)
                    tone = encode(to_srgb, tone + ink_light * taken * shown_fill)
                colour += line * (tone - colour)
                paint = pixels[row, column, c] * byte + paper - cover * drawn
                if shaded:
                    ratio = sample(floor, across, down, c)
                    plain = min(max(paint / max(behind, np.float32(1e-3)), zero), one)
                    paint = behind * encode(to_srgb, to_linear[int(plain * 255)] * ratio)
                    shown[c] = encode(to_srgb, ratio)
                    darkest = min(darkest, shown[c])
                fill[c] = cover * colour + paint
            if shaded:
                bare = min(max(one - cover - behind, zero), one)
                for c in range(3):
                    fill[c] += bare * (shown[c] - darkest)
                ground_alpha += bare * (one - darkest)
            total = min(max(cover + ground_alpha, zero), one)
            if paper > 0:
                least = alpha
                for c in range(3):
                    least = max(least, total - fill[c])
                for c in range(3):
                    fill[c] += least - total
                total = min(least, one)
            for c in range(3):
                lit[row, column, c] = np.uint8(min(max(fill[c], zero), total) * 255 + 0.5)
            lit[row, column, 3] = np.uint8(total * 255 + 0.5)
