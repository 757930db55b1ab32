"""A plot of the mean angle over the minutes of a run."""

from __future__ import annotations

from pathlib import Path

from PIL import Image, ImageDraw

from lampblack.atomic import atomic_file

SIZE = (640, 400)
_LEFT, _TOP, _RIGHT, _BOTTOM = 48, 28, 624, 368
_DEGREES, _MINUTES = (1, 2, 5, 10, 20), (1, 2, 5, 10, 20, 60, 120, 300, 600, 1200)
_MOST_TICKS = 8
INK, GRID, LINE = "#222222", "#d8d8d8", "#b03a2e"


def save_curve(path: Path, minutes: list[float], angles: list[float], title: str) -> None:
    """Write a PNG of mean angles in degrees at these minutes. The first angles, of the
    untrained network, may lie above the plot."""
    picture = Image.new("RGB", SIZE, "white")
    pen = ImageDraw.Draw(picture)
    later = sorted(angles)[: max(1, round(0.95 * len(angles)))]
    low, high = min(later) - 0.5, max(later) + 0.5
    last = max(minutes[-1], 1e-3)

    def place(minute: float, angle: float) -> tuple[float, float]:
        x = _LEFT + (_RIGHT - _LEFT) * minute / last
        return x, max(_TOP, _BOTTOM - (_BOTTOM - _TOP) * (angle - low) / (high - low))

    for tick in _ticks(low, high, _DEGREES):
        y = place(0, tick)[1]
        pen.line([(_LEFT, y), (_RIGHT, y)], fill=GRID)
        pen.text((_LEFT - 6, y), str(tick), fill=INK, anchor="rm")
    for tick in _ticks(0, last, _MINUTES):
        x = place(tick, low)[0]
        pen.line([(x, _TOP), (x, _BOTTOM)], fill=GRID)
        pen.text((x, _BOTTOM + 6), str(tick), fill=INK, anchor="ma")
    pen.line([place(*point) for point in zip(minutes, angles, strict=True)], fill=LINE, width=2)
    pen.text((_LEFT, 8), f"{title}: mean angle in training, degrees", fill=INK)
    pen.text((_RIGHT, _BOTTOM + 18), "minutes", fill=INK, anchor="ra")
    with atomic_file(path) as file:
        picture.save(file, "PNG")


def _ticks(low: float, high: float, steps: tuple[int, ...]) -> list[int]:
    step = next((s for s in steps if (high - low) / s <= _MOST_TICKS), steps[-1])
    first = -int(-low // step) * step
    return [tick for tick in range(first, int(high) + 1, step) if low <= tick <= high]
