"""Plot what a shot costs as it grows, and its memory, from the figures of
``lampblack bench scale --json``.

python scripts/plot_scale.py docs/data/scale.json docs/images/scale.svg
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from math import ceil, floor, log10
from pathlib import Path

from lampblack.atomic import atomic_file
from lampblack.bench.scale import EVERY, MANY, STEPS

TITLES = {
    "held_frames": "frames that hold one drawing",
    "drawings": "distinct drawings",
    "pixels": "side of the canvas, pixels",
    "lights": "lights",
}
WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 420, 300, 58, 46, 400, 252
"""Of a plot, and the frame inside it, pixels."""


def panel(what: str, figures: Mapping[str, float]) -> list[str]:
    """One plot, both axes logarithmic."""
    steps = STEPS[what]
    spent = [figures[f"{what}_{step}"] for step in steps]
    low, high = floor(log10(min(spent))), ceil(log10(max(spent)))

    def x(step: float) -> float:
        share = log10(step / steps[0]) / log10(steps[-1] / steps[0])
        return LEFT + (RIGHT - LEFT) * share

    def y(seconds: float) -> float:
        return BOTTOM - (BOTTOM - TOP) * (log10(seconds) - low) / (high - low)

    lines = [
        f'<text class="head" x="{LEFT}" y="18">{TITLES[what]}</text>',
        f'<text x="{LEFT}" y="36">processor seconds, growing with the power '
        f"{figures[f'{what}_exponent']:.2f} at the end</text>",
    ]
    for tick in (10.0**power for power in range(low, high + 1)):
        lines += [
            f'<line class="grid" x1="{LEFT}" x2="{RIGHT}" y1="{y(tick):.1f}" y2="{y(tick):.1f}"/>',
            f'<text class="side" x="{LEFT - 8}" y="{y(tick) + 4:.1f}">{tick:g}</text>',
        ]
    points = " ".join(f"{x(n):.1f},{y(s):.1f}" for n, s in zip(steps, spent, strict=True))
    lines.append(f'<polyline points="{points}"/>')
    for step, seconds in zip(steps, spent, strict=True):
        lines += [
            f'<circle cx="{x(step):.1f}" cy="{y(seconds):.1f}" r="4"/>',
            f'<text class="under" x="{x(step):.1f}" y="{BOTTOM + 20}">{step}</text>',
            f'<text class="under" x="{x(step):.1f}" y="{y(seconds) - 10:.1f}">{seconds:.3g}</text>',
        ]
    return lines


def memory(figures: Mapping[str, float]) -> list[str]:
    """Memory against drawings, as wide as two plots, both axes linear."""
    drawings = range(EVERY, MANY + 1, EVERY)
    used = [figures[f"memory_{count}"] for count in drawings]
    top = 500 * ceil(max(used) / 500)

    def x(count: int) -> float:
        return LEFT + (WIDTH + RIGHT - LEFT) * count / MANY

    def y(mebibytes: float) -> float:
        return BOTTOM - (BOTTOM - TOP) * mebibytes / top

    lines = [
        f'<text class="head" x="{LEFT}" y="18">distinct drawings of one long shot</text>',
        f'<text x="{LEFT}" y="36">MiB of all processes after each of them, at low quality</text>',
    ]
    for tick in range(0, top + 1, 500):
        lines += [
            f'<line class="grid" x1="{LEFT}" x2="{WIDTH + RIGHT}" y1="{y(tick)}" y2="{y(tick)}"/>',
            f'<text class="side" x="{LEFT - 8}" y="{y(tick) + 4:.1f}">{tick}</text>',
        ]
    points = " ".join(f"{x(n):.1f},{y(m):.1f}" for n, m in zip(drawings, used, strict=True))
    lines.append(f'<polyline points="{points}"/>')
    for count in range(0, MANY + 1, 100):
        lines.append(f'<text class="under" x="{x(count):.1f}" y="{BOTTOM + 20}">{count}</text>')
    return lines


def picture(figures: Mapping[str, float]) -> str:
    """The five plots as SVG."""
    lines = []
    for number, what in enumerate(STEPS):
        right, down = WIDTH * (number % 2), HEIGHT * (number // 2)
        lines += [f'<g transform="translate({right} {down + 10})">', *panel(what, figures), "</g>"]
    lines += [f'<g transform="translate(0 {2 * HEIGHT + 10})">', *memory(figures), "</g>"]
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {2 * WIDTH} {3 * HEIGHT + 10}" '
            'font-family="sans-serif" font-size="12">',
            f'<rect width="{2 * WIDTH}" height="{3 * HEIGHT + 10}" fill="#fff"/>',
            "<style>.grid{stroke:#ddd}.head{font-weight:bold}.side{text-anchor:end}"
            ".under{text-anchor:middle}polyline{fill:none;stroke:#b03a2e;stroke-width:2}"
            "circle{fill:#b03a2e}</style>",
            *lines,
            "</svg>\n",
        ]
    )


if __name__ == "__main__":
    figures = json.loads(Path(sys.argv[1]).read_text())
    with atomic_file(Path(sys.argv[2])) as file:
        file.write(picture(figures).encode())
