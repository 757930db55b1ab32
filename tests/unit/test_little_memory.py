"""Files that are too large, or say too much, are refused before they fill the memory."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest

from lampblack.drawing import load_picture
from lampblack.errors import DrawingError, LampblackError, ProjectError
from lampblack.project import read_project
from lampblack.project.shot import ProjectShot
from support.memory import little_memory
from support.paths import ROOT
from support.projects import document, layer, write_project

LAYERED = ROOT / "tests" / "data" / "layers"


def rezipped(source: Path, target: Path, name: str, content: bytes) -> Path:
    """A copy of a zip with another file under ``name``."""
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as new:
        for entry in old.namelist():
            new.writestr(entry, content if entry == name else old.read(entry))
    return target


@pytest.mark.parametrize("start", [b"II*\0\x08\0\0\0", b"\x89PNG\r\n\x1a\n"])
def test_a_picture_file_that_is_too_large_is_not_read(tmp_path: Path, start: bytes) -> None:
    path = tmp_path / "a.tif"
    with path.open("wb") as file:
        file.write(start)
        file.truncate(300 << 20)
    with little_memory(30 << 20), pytest.raises(DrawingError, match="ordinary size"):
        load_picture(path)


ELEMENTS = "<x/>" * 1_000_000
ATTRIBUTES = "<x " + "a='' " * 1_600_000 + "/>"


@pytest.mark.parametrize("many", [ELEMENTS, ATTRIBUTES], ids=["elements", "attributes"])
@pytest.mark.parametrize("kind", ["pclx", "ora", "kra"])
def test_descriptions_of_too_many_parts(tmp_path: Path, kind: str, many: str) -> None:
    if kind == "pclx":
        xml = document([layer(2, "x", [])]).replace("</object>", many + "</object>")
        path = write_project(tmp_path / "a.pclx", xml)
    else:
        source = LAYERED / f"krita.{kind}"
        name, place = ("stack.xml", "</stack>") if kind == "ora" else ("maindoc.xml", "</layers>")
        with zipfile.ZipFile(source) as archive:
            xml = archive.read(name).decode()
        made = xml.replace(place, many + place, 1).encode()
        path = rezipped(source, tmp_path / f"a.{kind}", name, made)
    with little_memory(), pytest.raises(ProjectError, match="more parts than can be read"):
        read_project(path)


def test_a_layer_of_krita_that_unpacks_to_its_limit(tmp_path: Path) -> None:
    source = LAYERED / "krita.kra"
    with zipfile.ZipFile(source) as archive:
        names = [n for n in archive.namelist() if "/layers/" in n and "." not in n.split("/")[-1]]
    path = rezipped(source, tmp_path / "a.kra", names[0], bytes(127 << 20))
    sound, spoilt = (ProjectShot(*read_project(each), {}) for each in (source, path))
    sound.cel(sound.frames[0])  # what reads it is loaded, and stays
    with little_memory(300 << 20), pytest.raises(LampblackError, match="damaged"):
        spoilt.cel(spoilt.frames[0])
