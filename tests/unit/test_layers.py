"""The map in CONTRIBUTING.md: its tables are the order in which stations import each other."""

from __future__ import annotations

from graphlib import TopologicalSorter

import pytest

from architecture import picture
from support.paths import ROOT
from support.stations import HEADINGS, PLUGIN, WORKER, files, imports, includes, order

both = pytest.mark.parametrize("package", HEADINGS)


@both
def test_the_map_names_every_station_once(package: str) -> None:
    assert sorted(order(HEADINGS[package])) == sorted({station for station, _ in files(package)})


@both
def test_stations_import_only_those_above_them_on_the_map(package: str) -> None:
    stations = order(HEADINGS[package])
    upward = [
        f"{path.relative_to(ROOT)} imports {'.'.join(module)}"
        for station, path in files(package)
        for module in imports(path)
        if module[0] == package and {*module[1:2]} & {*stations[stations.index(station) + 1 :]}
    ]
    assert upward == []


@both
def test_modules_do_not_import_each_other_in_a_circle(package: str) -> None:
    modules = {path.relative_to(WORKER).with_suffix("").parts: path for _, path in files(package)}
    graph = {
        module: {part for name in imports(path) for part in (name, name[:-1]) if part in modules}
        for module, path in modules.items()
    }
    TopologicalSorter(graph).prepare()  # raises CycleError, which names the circle


@both
def test_only_the_renderer_imports_blender(package: str) -> None:
    """``bpy`` runs in a process of its own: nothing else may load it."""
    importing = {station for station, path in files(package) for m in imports(path) if "bpy" in m}
    assert importing == {"render"}


def test_the_worker_does_not_import_research() -> None:
    imported = {module[0] for _, path in files("lampblack") for module in imports(path)}
    assert "lampblack_research" not in imported


def test_libraries_of_the_plugin_include_only_those_above_them_on_the_map() -> None:
    libraries = order("library")
    folders = {path.parent.relative_to(PLUGIN).parts[0] for path in PLUGIN.glob("*/**/*.h")}
    assert sorted(libraries) == sorted(folders)
    upward = [
        f"{path.relative_to(ROOT)} includes {name}/"
        for library, path, name in includes()
        if name in libraries[libraries.index(library) + 1 :]
    ]
    assert upward == []


def test_the_picture_of_the_architecture_is_current() -> None:
    """``make schema`` draws it again."""
    drawn = ROOT / "docs" / "images" / "architecture.svg"
    assert drawn.read_text(encoding="utf-8") == picture()
