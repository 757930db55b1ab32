"""The map in CONTRIBUTING.md, and what the code imports: read for the tests and for the picture."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from .paths import ROOT

WORKER = ROOT / "worker"
PLUGIN = ROOT / "pencil2d_plugin"
HEADINGS = {"lampblack": "station", "lampblack_research": "stage"}
"""By package, the heading of its table."""


def rows(heading: str) -> list[list[str]]:
    """The rows of the table whose first column has this heading: the folders and files of each."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    table = text.partition(f"| {heading} |")[2].partition("\n\n")[0]
    first_cells = (row.split("|")[1] for row in table.splitlines()[2:])
    return [re.findall(r"`(\w+)(?:/|\.py)`", cell) for cell in first_cells]


def order(heading: str) -> list[str]:
    """Folders and files in the order of the table whose first column has this heading."""
    return [name for row in rows(heading) for name in row]


def imports(path: Path) -> Iterator[tuple[str, ...]]:
    """Every module imported anywhere in a file, in functions and for type checkers too."""
    package = path.relative_to(WORKER).parent.parts
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (tuple(name.name.split(".")) for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) + 1 - node.level] if node.level else ()
            module = (*base, *(node.module or "").split("."))
            yield from ((*filter(None, module), name.name) for name in node.names)


def files(package: str) -> Iterator[tuple[str, Path]]:
    """Each file with its station; a package's own ``__init__`` and ``__main__`` have none."""
    for path in sorted((WORKER / package).rglob("*.py")):
        station = path.relative_to(WORKER / package).with_suffix("").parts[0]
        if not station.startswith("__"):
            yield station, path


def includes() -> Iterator[tuple[str, Path, str]]:
    """Each library of the plugin with a file of its own, and a library which that includes."""
    for path in sorted(PLUGIN.glob("*/**/*")):
        if path.suffix in (".h", ".cpp"):
            library = path.relative_to(PLUGIN).parts[0]
            for name in re.findall(r'#include "(\w+)/', path.read_text(encoding="utf-8")):
                yield library, path, name
