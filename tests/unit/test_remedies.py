"""Errors for people: each says what to do, and it can be done."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from lampblack.drawing import find_frames
from lampblack.errors import LampblackError
from lampblack.project import read_project
from lampblack.project.shot import ProjectShot
from support.krita import write_kra
from support.paths import ROOT

ERRORS = {"LampblackError", "DrawingError", "ProjectError", "SceneError", "OutputError"}
CODE = ROOT / "worker/lampblack"
WITHOUT = {"finals/exr.py", "finals/ora.py"}
"""What is raised there is for the code around it only."""


@pytest.mark.parametrize("folder", ["project", "finals", "cli", "farm", "rigs", "looks"])
def test_every_error_says_what_to_do(folder: str) -> None:
    bare = [
        f"{file.relative_to(CODE)}:{call.lineno}"
        for file in (CODE / folder).rglob("*.py")
        if str(file.relative_to(CODE)) not in WITHOUT
        for call in ast.walk(ast.parse(file.read_text()))
        if isinstance(call, ast.Call)
        and isinstance(call.func, ast.Name)
        and call.func.id in ERRORS
        and len(call.args) + len(call.keywords) < 2
    ]
    assert bare == []


def test_a_folder_of_projects_names_one(tmp_path: Path) -> None:
    for name in ("walk 2.PCLX", "walk 1.pclx", "notes.txt"):
        (tmp_path / name).touch()
    with pytest.raises(LampblackError, match="projects") as told:
        find_frames([tmp_path])
    assert str(tmp_path / "walk 1.pclx") in told.value.remedy


@pytest.mark.parametrize("other", ["Pencil2D", "redraw the frame"])
def test_a_file_of_krita_is_not_sent_to_pencil2d(tmp_path: Path, other: str) -> None:
    layer = '<layer nodetype="paintlayer" name="body" filename="gone"/>'
    shot = ProjectShot(*read_project(write_kra(tmp_path / "hero.kra", layer, {})), {})
    with pytest.raises(LampblackError, match="has no hero/layers/gone") as told:
        shot.cel(shot.frames[0])
    assert other not in str(told.value)


def test_a_file_that_makes_no_sense_can_be_saved_again(tmp_path: Path) -> None:
    layer = '<layer nodetype="paintlayer" name="body" filename="gone" x="many"/>'
    with pytest.raises(LampblackError, match="not possible") as told:
        read_project(write_kra(tmp_path / "hero.kra", layer, {}))
    assert "in its own program" in told.value.remedy
