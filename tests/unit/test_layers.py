"""The map in CONTRIBUTING.md: its tables are the order in which stations import each other."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

from support.paths import ROOT

WORKER = ROOT / "worker"
PLUGIN = ROOT / "pencil2d_plugin"
HEADINGS = {"lampblack": "station", "lampblack_research": "stage"}
"""By package, the heading of its table."""

both = pytest.mark.parametrize("package", HEADINGS)


def _order(heading: str) -> list[str]:
    """Folders and files in the order of the table whose first column has this heading."""
    text = (ROOT / "CONTRIBUTING.md").read_text()
    table = text.partition(f"| {heading} |")[2].partition("\n\n")[0]
    first_cells = (row.split("|")[1] for row in table.splitlines()[2:])
    return [name for cell in first_cells for name in re.findall(r"`(\w+)(?:/|\.py)`", cell)]


def _imports(path: Path) -> Iterator[tuple[str, ...]]:
    """Every module imported anywhere in a file, in functions and for type checkers too."""
    package = path.relative_to(WORKER).parent.parts
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (tuple(name.name.split(".")) for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) + 1 - node.level] if node.level else ()
            module = (*base, *(node.module or "").split("."))
            yield from ((*filter(None, module), name.name) for name in node.names)


def _files(package: str) -> Iterator[tuple[str, Path]]:
    """Each file with its station; a package's own ``__init__`` and ``__main__`` have none."""
    for path in sorted((WORKER / package).rglob("*.py")):
        station = path.relative_to(WORKER / package).with_suffix("").parts[0]
        if not station.startswith("__"):
            yield station, path


@both
def test_the_map_names_every_station_once(package: str) -> None:
    assert sorted(_order(HEADINGS[package])) == sorted({station for station, _ in _files(package)})


@both
def test_stations_import_only_those_above_them_on_the_map(package: str) -> None:
    order = _order(HEADINGS[package])
    upward = [
        f"{path.relative_to(ROOT)} imports {'.'.join(module)}"
        for station, path in _files(package)
        for module in _imports(path)
        if module[0] == package and {*module[1:2]} & {*order[order.index(station) + 1 :]}
    ]
    assert upward == []


@both
def test_modules_do_not_import_each_other_in_a_circle(package: str) -> None:
    modules = {path.relative_to(WORKER).with_suffix("").parts: path for _, path in _files(package)}
    graph = {
        module: {part for name in _imports(path) for part in (name, name[:-1]) if part in modules}
        for module, path in modules.items()
    }
    TopologicalSorter(graph).prepare()  # raises CycleError, which names the circle


@both
def test_only_the_renderer_imports_blender(package: str) -> None:
    """``bpy`` runs in a process of its own: nothing else may load it."""
    importing = {station for station, path in _files(package) for m in _imports(path) if "bpy" in m}
    assert importing == {"render"}


def test_the_worker_does_not_import_research() -> None:
    imported = {module[0] for _, path in _files("lampblack") for module in _imports(path)}
    assert "lampblack_research" not in imported


def test_libraries_of_the_plugin_include_only_those_above_them_on_the_map() -> None:
    order = _order("library")
    files = [path for path in PLUGIN.glob("*/**/*") if path.suffix in (".h", ".cpp")]
    assert sorted(order) == sorted({path.relative_to(PLUGIN).parts[0] for path in files})
    upward = [
        f"{path.relative_to(ROOT)} includes {name}/"
        for path in files
        for name in re.findall(r'#include "(\w+)/', path.read_text(encoding="utf-8"))
        if name in order[order.index(path.relative_to(PLUGIN).parts[0]) + 1 :]
    ]
    assert upward == []
