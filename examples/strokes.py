"""Splines, brush strokes and flat fills: the pen and paint with which the examples are drawn.

Everything is painted without anti-aliasing on a large sheet of colour indices, then averaged
down with premultiplied alpha: a flat colour stays exactly flat, and a pixel at the character's edge
keeps the straight colour of its line.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

Points = NDArray[np.float64]
"""(N, 2) x right, y down."""

SUPERSAMPLING = 8
NIB = np.array([0.5, 0.866])
"""The side that the pen leans on: lines are heavier below and to the right."""


def curve(knots: Sequence[tuple[float, float]] | Points, closed: bool = False) -> Points:
    """A smooth curve through ``knots``, about one point a unit; a knot given twice is a corner.

    A closed curve with corners must begin at one of them.
    """
    points = np.asarray(knots, dtype=np.float64)
    if closed:
        points = np.vstack([points, points[:1]])
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    corners = np.flatnonzero(steps == 0)
    pieces = np.split(points, corners + 1)
    smooth_ring = closed and len(pieces) == 1
    return np.vstack([_spline(piece, "periodic" if smooth_ring else "natural") for piece in pieces])


def _spline(knots: Points, ends: str) -> Points:
    """C2 cubic spline with centripetal knots, which does not overshoot on uneven ones."""
    if len(knots) == 1:
        return knots
    chords = np.linalg.norm(np.diff(knots, axis=0), axis=1)
    times = np.concatenate([[0.0], np.cumsum(np.sqrt(chords))])
    dense = CubicSpline(times, knots, bc_type=ends)(np.linspace(0, times[-1], 40 * len(knots)))
    lengths = arc_length(dense)
    count = max(int(lengths[-1]), 8)
    even = np.linspace(0, lengths[-1], count + 1)
    return np.column_stack([np.interp(even, lengths, dense[:, axis]) for axis in (0, 1)])


def arc_length(points: Points) -> NDArray[np.float64]:
    """Length along the polyline at every point, from 0."""
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])


def normals(points: Points) -> Points:
    """Unit normals, to the left of the direction of travel as seen on the page."""
    tangents = np.gradient(points, axis=0)
    tangents /= np.maximum(np.linalg.norm(tangents, axis=1, keepdims=True), 1e-9)
    return np.column_stack([tangents[:, 1], -tangents[:, 0]])


def ellipse(x: float, y: float, rx: float, ry: float, turn: float = 0.0) -> Points:
    """A closed ellipse, clockwise on the page; ``turn`` in degrees, clockwise."""
    t = np.linspace(0, 2 * np.pi, max(int(4 * max(rx, ry)), 24), endpoint=False)
    return place(np.column_stack([rx * np.cos(t), ry * np.sin(t)]), (x, y), turn)


def place(
    points: Sequence[tuple[float, float]] | Points,
    at: tuple[float, float] | Points,
    turn: float = 0.0,
    scale: tuple[float, float] = (1.0, 1.0),
) -> Points:
    """Points of a part's own frame turned by ``turn`` degrees clockwise, scaled, set down."""
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    turned = np.asarray(points, dtype=np.float64) @ np.array([[c, s], [-s, c]])
    set_down: Points = turned * np.asarray(scale) + np.asarray(at)
    return set_down


def bezier(start: Points, control: Points, end: Points) -> Points:
    """A quadratic Bezier curve, 64 points."""
    t = np.linspace(0, 1, 64)[:, None]
    points: Points = (1 - t) ** 2 * start + 2 * t * (1 - t) * control + t**2 * end
    return points


class Sheet:
    """A transparent sheet to draw on in the character's units.

    Args:
        size: (width, height) of the finished picture, pixels.
        colours: flat colours ``#rrggbb``; the first is the ink.
        to_canvas: from character units to pixels of the finished picture.
        scale: pixels for every character unit, for parts that keep their girth.
        ink_scale: pixels of line width for every unit of width asked for.
    """

    def __init__(
        self,
        size: tuple[int, int],
        colours: Sequence[str],
        to_canvas: Callable[[Points], Points],
        scale: float = 1.0,
        ink_scale: float = 1.0,
    ) -> None:
        self._colours = list(colours)
        self._to_canvas = to_canvas
        self._scale = scale
        self._ink_scale = ink_scale
        # Index 0 is bare sheet.
        self._labels = Image.new("L", (size[0] * SUPERSAMPLING, size[1] * SUPERSAMPLING))
        self._pen = ImageDraw.Draw(self._labels)

    def fill(self, outline: Points, colour: str, over: str | None = None) -> None:
        """Fill a closed outline; with ``over``, only where that colour lies now."""
        vertices = np.rint(self._to_canvas(outline) * SUPERSAMPLING).astype(int)
        index = self._colours.index(colour) + 1
        if over is None:
            self._pen.polygon([tuple(v) for v in vertices.tolist()], fill=index)
            return
        low, high = vertices.min(axis=0), vertices.max(axis=0) + 1
        box = (int(low[0]), int(low[1]), int(high[0]), int(high[1]))
        shape = Image.new("1", (box[2] - box[0], box[3] - box[1]))
        ImageDraw.Draw(shape).polygon([tuple(v) for v in (vertices - low).tolist()], fill=1)
        beneath = np.asarray(self._labels.crop(box)) == self._colours.index(over) + 1
        mask = Image.fromarray(np.asarray(shape) & beneath)
        self._labels.paste(index, box[:2], mask)

    def shape(self, outline: Points, colour: str, width: float) -> None:
        """Fill a closed outline and ink all of it."""
        self.fill(outline, colour)
        self.ink(outline, width, closed=True)

    def ink(
        self,
        line: Points,
        width: float,
        taper: tuple[float, float] = (0.0, 0.0),
        closed: bool = False,
        colour: str | None = None,
    ) -> None:
        """Draw a line with the brush.

        Args:
            line: where it runs; an outline runs clockwise, so that its outside is to the left.
            width: mean width in pixels before ``ink_scale``.
            taper: length at its start and end over which it thins out to a point, in pixels
                before ``ink_scale``.
            closed: join the end to the start.
            colour: another colour than the ink's, then of even width.
        """
        if closed:
            line = np.vstack([line, line[:1]])
        path = self._to_canvas(line)
        length = arc_length(path)
        even = np.linspace(0, length[-1], int(length[-1] * SUPERSAMPLING / 2) + 2)
        path = np.column_stack([np.interp(even, length, path[:, axis]) for axis in (0, 1)])
        widths = np.full(len(path), width * self._ink_scale)
        if colour is None:
            # A brush turns a corner gradually.
            turning = 5 * SUPERSAMPLING / 2
            edge = "wrap" if closed else "nearest"
            leaning = gaussian_filter1d(normals(path) @ NIB, turning, mode=edge)
            # Two swells of pressure over the whole line, so that it holds still in animation.
            pressure = 0.08 * np.sin(4 * np.pi * even / max(length[-1], 1e-9) + width)
            widths *= 1 + 0.34 * leaning + pressure
        for distance, reach in zip((even, even[-1] - even), taper, strict=True):
            if reach > 0:
                widths *= np.sqrt(np.clip(distance / (reach * self._ink_scale), 0.0, 1.0))
        index = (0 if colour is None else self._colours.index(colour)) + 1
        radii = np.maximum(widths * SUPERSAMPLING / 2, SUPERSAMPLING * 0.3)
        self._discs(path, radii / SUPERSAMPLING, index)

    def tube(
        self, axis: Points, radii: Sequence[float], colour: str, width: float, root: float
    ) -> None:
        """Draw a limb about ``axis``, ``radii`` spread evenly along it, with its outline.

        Unlike two offset curves, its outline never loops where the limb bends. The outline
        fades in over the share ``root`` of the length, so that the limb grows out of the body.
        """
        path = self._to_canvas(axis)
        length = arc_length(path)
        share = np.linspace(0, 1, int(length[-1] * 4) + 2)
        path = np.column_stack([np.interp(share * length[-1], length, path[:, k]) for k in (0, 1)])
        radius = np.interp(share, np.linspace(0, 1, len(radii)), radii) * self._scale
        half = width * self._ink_scale / 2
        inked = share > root / 2
        fade = np.sqrt(np.clip((share[inked] - root / 2) / (root / 2 + 1e-9), 0, 1))
        nib = 0.3 * half * NIB * fade[:, None]
        self._discs(path[inked] + nib, radius[inked] + half * (2 * fade - 1), 1)
        self._discs(path, radius - half, self._colours.index(colour) + 1)

    def _discs(self, centres: Points, radii: NDArray[np.float64], index: int) -> None:
        centres, radii = centres * SUPERSAMPLING, radii[:, None] * SUPERSAMPLING
        boxes = np.rint(np.hstack([centres - radii, centres + radii])).astype(int)
        for box in boxes.tolist():
            self._pen.ellipse(box, fill=index)

    def picture(self) -> Image.Image:
        """The finished picture: RGBA, straight alpha, 0 where nothing is drawn."""
        inks = [(*bytes.fromhex(colour[1:]), 255) for colour in self._colours]
        table = np.array([(0, 0, 0, 0), *inks], dtype=np.uint8)
        labels = np.asarray(self._labels)
        rows = [
            _average(table[labels[top : top + SUPERSAMPLING]])
            for top in range(0, len(labels), SUPERSAMPLING)
        ]
        return Image.fromarray(np.stack(rows), "RGBA")


def _average(samples: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """One row of pixels, (W, 4), from its (S, S * W, 4) samples; colours weighed by alpha."""
    height, width, _ = samples.shape
    blocks = samples.reshape(height, width // height, height, 4).sum(axis=(0, 2), dtype=np.int64)
    covered = np.maximum(blocks[:, 3:] // 255, 1)
    colour = (blocks[:, :3] + covered // 2) // covered
    alpha = (blocks[:, 3:] + height * height // 2) // (height * height)
    return np.hstack([colour, alpha]).astype(np.uint8)
