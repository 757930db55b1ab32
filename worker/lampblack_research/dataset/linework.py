"""Line drawings from a G-buffer: silhouettes, occlusions and creases in ink.

The line style varies from drawing to drawing, so that a network learns from many styles.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .gbuffer import GBuffer


@dataclass(frozen=True)
class LineStyle:
    """How lines are drawn.

    Attributes:
        width: line width, pixels.
        swell: how much the width changes along the line, 0 to 1.
        crease: angle in degrees between neighbouring normals that is drawn as a line.
        step: depth jump in pixels that is drawn as an occlusion.
        wobble: how far lines tremble, pixels.
        gaps: share of the line left open, 0 to 1.
        darkness: opacity of the ink, 0 to 1.
        black_fills: share of closed regions filled with ink.
        taper: share of the line that thins out towards its ends, 0 to 1.
        markings: share of the character under spots or stripes, which do not follow its shape.
    """

    width: float = 2.5
    swell: float = 0.0
    crease: float = 35.0
    step: float = 6.0
    wobble: float = 0.0
    gaps: float = 0.0
    darkness: float = 1.0
    black_fills: float = 0.0
    taper: float = 0.0
    markings: float = 0.0

    @staticmethod
    def random(rng: np.random.Generator, character_px: int) -> LineStyle:
        """A random style for a character of this size."""
        widest = 0.05 * character_px if rng.random() < 0.15 else 0.018 * character_px
        return LineStyle(
            width=float(np.exp(rng.uniform(np.log(0.9), np.log(max(widest, 2.5))))),
            swell=float(rng.uniform(0, 0.6)),
            # Two styles in five draw occlusions alone, as Freestyle's contours do.
            crease=180.0 if rng.random() < 0.4 else float(rng.uniform(25, 70)),
            step=character_px * float(np.exp(rng.uniform(np.log(0.003), np.log(0.03)))),
            wobble=float(rng.choice([0.0, 0.0, rng.uniform(0.3, 1.5)])),
            gaps=float(rng.choice([0.0, 0.0, rng.uniform(0, 0.2)])),
            darkness=float(rng.choice([1.0, rng.uniform(0.6, 1.0)])),
            black_fills=float(rng.choice([0.0, 0.0, rng.uniform(0, 0.2)])),
            taper=float(rng.choice([0.0, rng.uniform(0.1, 0.6)])),
            markings=float(rng.choice([0.0] * 7 + [rng.uniform(0.03, 0.2)])),
        )


def draw_lines(view: GBuffer, style: LineStyle, rng: np.random.Generator) -> NDArray[np.float32]:
    """Ink ``view``: (H, W) float32 in 0..1, 1 is full ink, 0 outside the mask."""
    mask = view.mask
    edges = _occlusions(view, style.step) | _creases(view, style.crease)
    edges |= mask & ~ndimage.binary_erosion(mask)
    edges &= mask
    if not edges.any():
        return np.zeros(mask.shape, np.float32)
    distance = ndimage.distance_transform_edt(~edges).astype(np.float32)
    if style.wobble > 0:
        offsets = [style.wobble * _noise(mask.shape, 24, rng) for _ in range(2)]
        rows, columns = np.mgrid[0 : mask.shape[0], 0 : mask.shape[1]].astype(np.float32)
        distance = ndimage.map_coordinates(
            distance, [rows + offsets[0], columns + offsets[1]], order=1, mode="nearest"
        )
    width = style.width * (1 + style.swell * _noise(mask.shape, 40, rng))
    if style.taper > 0:
        thinning = _noise(mask.shape, 32, rng)
        width = width * np.clip((thinning - np.quantile(thinning, style.taper / 2)) * 4, 0.15, 1)
    ink = np.clip(width / 2 - distance + 0.5, 0, 1) * np.clip(width, 0, 1)
    if style.gaps > 0:
        drawn = _noise(mask.shape, 20, rng)
        ink *= drawn > np.quantile(drawn, style.gaps)
    if style.markings > 0:
        ink = np.maximum(ink, _markings(mask, style, rng))
    ink *= style.darkness
    if style.black_fills > 0:
        regions, count = ndimage.label(mask & (distance > width / 2))
        sizes = np.bincount(regions.reshape(-1), minlength=count + 1)
        filled = rng.random(count + 1) < style.black_fills
        filled[0] = False
        filled[sizes > 0.15 * mask.sum()] = False
        # Only the border of a filled black is a line, as in a decomposed drawing.
        solid = ndimage.binary_dilation(filled[regions], iterations=2)
        ink = np.where(solid, np.clip(1.5 - distance, 0, 1) * style.darkness, ink)
    result: NDArray[np.float32] = (ink * mask).astype(np.float32)
    return result


def _markings(
    mask: NDArray[np.bool_], style: LineStyle, rng: np.random.Generator
) -> NDArray[np.float32]:
    """Draw outlines of spots, or of stripes."""
    rows, columns = np.indices(mask.shape, dtype=np.float32) / max(mask.shape)
    angle, pace = rng.uniform(0, np.pi), rng.choice([0.0, rng.uniform(8, 30)])
    field = _noise(mask.shape, max(6, max(mask.shape) // 14), rng)
    field = field + 1.5 * np.sin(
        2 * np.pi * pace * (rows * np.sin(angle) + columns * np.cos(angle))
    )
    field *= _noise(mask.shape, max(8, max(mask.shape) // 5), rng) > 0.2
    spots = (field > np.quantile(field[mask], 1 - style.markings)) & mask
    distance = ndimage.distance_transform_edt(spots ^ ndimage.binary_erosion(spots) ^ True)
    inked: NDArray[np.float32] = np.clip(min(style.width, 4) / 2 - distance + 0.5, 0, 1)
    return inked.astype(np.float32)


def _occlusions(view: GBuffer, step: float) -> NDArray[np.bool_]:
    """The nearer side of every depth jump. Second differences ignore slopes."""
    depth = np.where(view.mask, view.depth, 0)
    found = np.zeros(view.mask.shape, bool)
    for axis in (0, 1):
        before, after = np.roll(depth, 1, axis), np.roll(depth, -1, axis)
        found |= (2 * depth - before - after > step) & view.mask
    return found


def _creases(view: GBuffer, degrees: float) -> NDArray[np.bool_]:
    """Pixels whose normal turns by more than ``degrees`` towards the right or down."""
    found = np.zeros(view.mask.shape, bool)
    limit = np.cos(np.radians(degrees))
    for axis in (0, 1):
        turned = np.roll(view.normals, -1, axis)
        both = view.mask & np.roll(view.mask, -1, axis)
        found |= both & (np.einsum("hwc,hwc->hw", view.normals, turned) < limit)
    return found


def _noise(shape: tuple[int, ...], period: int, rng: np.random.Generator) -> NDArray[np.float32]:
    """Smooth noise in about -1..1 whose bumps are ``period`` pixels wide."""
    coarse = rng.uniform(-1, 1, (shape[0] // period + 3, shape[1] // period + 3))
    zoomed = ndimage.zoom(coarse.astype(np.float32), period, order=1)
    result: NDArray[np.float32] = zoomed[: shape[0], : shape[1]]
    return result
