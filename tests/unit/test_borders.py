"""Borders between materials stay as smooth as the artist's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.colour import linear, srgb
from lampblack.composite import composite
from lampblack.composite.borders import mixed_labels
from lampblack.composite.byte_layers import byte_layers_of, premultiplied
from lampblack.composite.illumination import Illumination
from lampblack.drawing import Drawing, Palette
from lampblack.drawing.palette import Swatch
from lampblack.render.passes import LightPasses, Passes
from lampblack.scene import Ambient, Material, Scene, default_scene

SIZE = 64
FUR, EYE = "#f0d8b0", "#201828"
NO_LIGHT = np.zeros((1, 1, 3), np.float32)
UNIT = np.ones((1, 1, 3), np.float32)


def colour(key: str) -> NDArray[np.float32]:
    return np.frombuffer(bytes.fromhex(key[1:]), np.uint8).astype(np.float32) / 255


def disk() -> NDArray[np.float32]:
    """How much of each pixel a disk covers, from 16 x 16 samples."""
    fine = 16
    place = (np.arange(SIZE * fine) + 0.5) / fine - SIZE / 2
    inside = np.hypot(place[:, None], place + 0.3) < 14
    return inside.reshape(SIZE, fine, SIZE, fine).mean(axis=(1, 3)).astype(np.float32)


def eye() -> Drawing:
    """A dark disk on a light ground, blended as paint programs do."""
    share = disk()
    albedo = share[..., None] * colour(EYE) + (1 - share[..., None]) * colour(FUR)
    pixels = np.dstack([np.rint(albedo * 255), np.full((SIZE, SIZE), 255)]).astype(np.uint8)
    all_of_it, none = np.ones((SIZE, SIZE), np.float32), np.zeros((SIZE, SIZE), np.float32)
    return Drawing(
        pixels,
        all_of_it > 0,
        all_of_it,
        none,
        none,
        np.zeros((SIZE, SIZE, 3), np.float32),
        albedo,
        (share > 0.5).astype(np.int16),
        Palette((Swatch(FUR, 1), Swatch(EYE, 1))),
    )


def unlit_eye() -> Scene:
    """Nothing but unit ambient light; the eye has no diffuse part."""
    scene = default_scene(SIZE, SIZE)
    materials = {FUR: Material(), EYE: Material(diffuse=False, glossy=True)}
    return replace(scene, lights=(), ambient=Ambient("#ffffff", 1.0), materials=materials)


def test_blends_are_found_at_borders_alone() -> None:
    palette = Palette((Swatch("#ffffff", 1), Swatch("#000000", 1)))
    labels = np.zeros((5, 6), np.int16)
    labels[:, 3:] = 1
    labels[4] = -1
    albedo = np.where(labels[..., None] == 0, np.float32(1), np.float32(0)) * np.ones(3, np.float32)
    albedo[:, 2] = 0.75
    other, share = mixed_labels(labels, albedo, palette)
    assert (other[:4, 2] == 1).all()
    assert share[:4, 2] == pytest.approx(0.25)
    share[:4, 2] = 0
    assert not share.any()


def test_blends_of_a_third_colour_are_none() -> None:
    palette = Palette((Swatch("#ffffff", 1), Swatch("#000000", 1)))
    labels = np.zeros((3, 4), np.int16)
    labels[:, 2:] = 1
    albedo = np.where(labels[..., None] == 0, np.float32(1), np.float32(0)) * np.ones(3, np.float32)
    albedo[1, 1] = (0.8, 0.1, 0.1)
    assert not mixed_labels(labels, albedo, palette)[1].any()


def test_an_unlit_colour_leaves_its_share_of_the_pixel_dark() -> None:
    drawing = eye()
    dark = composite(drawing, Passes((), LightPasses(UNIT, NO_LIGHT)), unlit_eye())
    inside = disk() == 1
    outside = disk() == 0
    assert not dark[inside, :3].any()
    assert np.abs(dark[outside] - drawing.pixels[outside].astype(int)).max() <= 1
    # On the border: the pixel as drawn, less the eye's part of it.
    mixed = linear(drawing.pixels[..., :3] / 255)
    apart = linear(colour(EYE)) - linear(colour(FUR))
    share = np.clip(((mixed - linear(colour(FUR))) @ apart) / (apart @ apart), 0, 1)
    wanted = srgb(np.maximum(mixed - share[..., None] * linear(colour(EYE)), 0)) * 255
    border = ~inside & ~outside
    # Paint programs blend in sRGB, a little off the line that light takes.
    assert np.abs(dark[border, :3] - wanted[border]).max() <= 9
    # No step is left that the drawing does not have.
    steps = [
        np.abs(np.diff(picture[SIZE // 2, :, 1].astype(int))).max()
        for picture in (dark, drawing.pixels)
    ]
    assert steps[0] <= 1.35 * steps[1]


def test_previews_agree_at_borders() -> None:
    rng = np.random.default_rng(0)
    drawing, scene = eye(), unlit_eye()
    given = LightPasses(
        rng.uniform(0.3, 0.9, (8, 8, 3)).astype(np.float32),
        rng.uniform(0, 0.4, (8, 8, 3)).astype(np.float32),
    )
    wanted = premultiplied(composite(drawing, Passes((), given), scene)).astype(int)
    found = composite(byte_layers_of(drawing), Passes((), given), scene).astype(int)
    assert np.abs(found - wanted).max() <= 4


def test_enlarged_borders_are_smooth() -> None:
    drawing, scene = eye(), unlit_eye()
    zoom, whole = 4, (0.0, 0.0, float(SIZE), float(SIZE))
    layers = byte_layers_of(drawing).cut(whole, (zoom * SIZE, zoom * SIZE))
    light = Illumination([(np.ones(3, np.float32), UNIT, NO_LIGHT)])
    found = composite(layers, light, scene, whole).astype(int)
    row = found[zoom * SIZE // 2, :, 1]
    drawn = layers.pixels[zoom * SIZE // 2, :, 1].astype(int)
    assert np.abs(np.diff(row)).max() <= 1.5 * np.abs(np.diff(drawn)).max()
