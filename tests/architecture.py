"""Draw the stations of the worker and the libraries of the plugin, and which uses which.

python tests/architecture.py docs/images/architecture.svg
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path

from lampblack.atomic import atomic_file
from support.stations import HEADINGS, files, imports, includes, order, rows

Uses = dict[str, set[str]]
"""By box, the boxes that it uses itself."""
HEIGHT, WIDE, GAP_X, GAP_Y = 30, 8, 56, 34
"""A box, a letter, and the room between boxes, in pixels."""


def stations() -> Uses:
    """The rows of the map of the worker, each named by its first files and folders."""
    names = {name: _label(row) for row in rows(HEADINGS["lampblack"]) for name in row}
    uses: Uses = {label: set() for label in names.values()}
    for station, path in files("lampblack"):
        for module in imports(path):
            used = names.get(module[1]) if module[0] == "lampblack" and module[1:] else None
            if used and used != names[station]:
                uses[names[station]].add(used)
    return uses


def _label(row: Sequence[str]) -> str:
    return ", ".join(row[:3]) + (" ..." if len(row) > 3 else "")


def libraries() -> Uses:
    """The libraries of the plugin."""
    uses: Uses = {name: set() for name in order("library")}
    for library, _, used in includes():
        if used in uses and used != library:
            uses[library].add(used)
    return uses


def _reached(name: str, uses: Mapping[str, set[str]]) -> set[str]:
    """What ``name`` uses, and what that uses."""
    return uses[name].union(*(_reached(used, uses) for used in uses[name]))


def direct(uses: Uses) -> Uses:
    """Without the arrows that follow from others."""
    return {
        name: used - set().union(*(_reached(other, uses) for other in used))
        for name, used in uses.items()
    }


@dataclass(frozen=True)
class Box:
    """One station: its middle and its width, in pixels."""

    x: float
    y: float
    width: float


def place(uses: Uses, left: float, width: float, top: float) -> dict[str, Box]:
    """Boxes in levels: each lies below all that it uses."""
    level: dict[str, int] = {}
    for name in uses:  # in the order of the map: what a station uses comes before it
        level[name] = 1 + max((level[used] for used in uses[name]), default=-1)
    boxes = {}
    for row in range(max(level.values()) + 1):
        names = [name for name in uses if level[name] == row]
        widths = [WIDE * len(name) + 20 for name in names]
        x = left + (width - sum(widths) - GAP_X * (len(names) - 1)) / 2
        for name, wide in zip(names, widths, strict=True):
            boxes[name] = Box(x + wide / 2, top + row * (HEIGHT + GAP_Y), wide)
            x += wide + GAP_X
    return boxes


def _drawn(uses: Uses, boxes: Mapping[str, Box], colour: str) -> list[str]:
    lines = [
        f'<line x1="{boxes[name].x:.0f}" y1="{boxes[name].y - HEIGHT / 2:.0f}" '
        f'x2="{boxes[used].x:.0f}" y2="{boxes[used].y + HEIGHT / 2:.0f}" marker-end="url(#tip)"/>'
        for name, all_used in direct(uses).items()
        for used in sorted(all_used)
    ]
    for name, box in boxes.items():
        lines += [
            f'<rect x="{box.x - box.width / 2:.0f}" y="{box.y - HEIGHT / 2:.0f}" rx="5" '
            f'width="{box.width:.0f}" height="{HEIGHT}" fill="{colour}"/>',
            f'<text x="{box.x:.0f}" y="{box.y + 5:.0f}">{escape(name)}</text>',
        ]
    return lines


def picture() -> str:
    """The picture as SVG. An arrow leads to what is used."""
    worker, plugin = stations(), libraries()
    left, right = place(worker, 20, 760, 80), place(plugin, 800, 240, 80)
    height = max(box.y for box in (*left.values(), *right.values())) + 40
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 1060 {height:.0f}" '
            'font-family="sans-serif" font-size="14" text-anchor="middle">',
            '<defs><marker id="tip" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="7" '
            'markerHeight="7" orient="auto"><path d="M0 0L8 4L0 8z" fill="#777"/></marker></defs>',
            f'<rect width="1060" height="{height:.0f}" fill="#fff"/>',
            "<style>line{stroke:#777}rect[rx]{stroke:#555}.head{font-weight:bold}</style>",
            '<text class="head" x="400" y="35">worker/lampblack (Python)</text>',
            '<text class="head" x="920" y="35">pencil2d_plugin (C++)</text>',
            *_drawn(worker, left, "#fdf3dc"),
            *_drawn(plugin, right, "#dcebf7"),
            "</svg>\n",
        ]
    )


if __name__ == "__main__":
    with atomic_file(Path(sys.argv[1])) as file:
        file.write(picture().encode())
