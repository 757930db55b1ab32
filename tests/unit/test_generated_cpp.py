"""The C++ that mirrors the scene and the messages follows from the Python types alone."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

import pytest
from msgspec import Meta

from lampblack.protocol.cpp.fields import fields_of
from lampblack.protocol.cpp.members import Translator
from support.paths import ROOT

WORDS = ("soft", "very_hard")


@pytest.mark.parametrize(
    ("hint", "default", "declaration", "call"),
    [
        (bool, True, "bool f = true;", 'fields.boolean("f", value.f, Need::Optional);'),
        (
            Annotated[int, Meta(ge=2, le=9)],
            ...,
            "int f = 2;",
            'fields.integer("f", value.f, 2, 9);',
        ),
        (
            Annotated[float, Meta(ge=-1e5, le=0.5)],
            0.25,
            "double f = 0.25;",
            'fields.real("f", value.f, -100000, 0.5, Need::Optional);',
        ),
        (
            Annotated[str, Meta(max_length=8, pattern="^a$")],
            "",
            "QString f = {};",
            'fields.text("f", value.f, 0, 8, patterns().f, Need::Optional);',
        ),
        (
            Literal["soft", "very_hard"],
            "very_hard",
            "Edge f = Edge::VeryHard;",
            'fields.choice("f", value.f, EdgeChoices, Need::Optional);',
        ),
        (
            Annotated[int, Meta(ge=0, le=5)] | None,
            None,
            "std::optional<int> f = {};",
            'fields.integer("f", value.f, 0, 5);',
        ),
    ],
)
def test_a_field_is_a_member_and_a_call(
    hint: Any, default: Any, declaration: str, call: str
) -> None:
    member = Translator({WORDS: "Edge"}).member("Thing", _field(hint, default))
    assert (member.declaration, member.call) == (declaration, call)


@pytest.mark.parametrize("hint", [float, Literal["new"], set[int], Annotated[int, Meta(ge=0)]])
def test_what_has_no_cpp_is_refused(hint: Any) -> None:
    with pytest.raises(TypeError):
        Translator({WORDS: "Edge"}).member("Thing", _field(hint, ...))


def _field(hint: Any, default: Any) -> Any:
    space: dict[str, Any] = {"__annotations__": {"f": hint}}
    if default is not ...:
        space["f"] = default
    (field,) = fields_of(dataclass(type("Thing", (), space)))
    return field


def test_a_scene_field_is_one_line_of_python(tmp_path: Path) -> None:
    """The example of CONTRIBUTING.md: every generated file that knows scenes has the new field."""
    for folder in ("worker/lampblack", "protocol"):
        keep = shutil.ignore_patterns("weights", "__pycache__")
        shutil.copytree(ROOT / folder, tmp_path / folder, ignore=keep)
    shutil.copy(ROOT / ".clang-format", tmp_path)
    scene = tmp_path / "worker" / "lampblack" / "scene" / "scene.py"
    head, mark, tail = scene.read_text().partition("    quality: ")
    line = '    exposure: Annotated[float, Meta(ge=-8, le=8, description="stops")] = 0.0\n'
    scene.write_text(head + line + mark + tail)

    environment = {**os.environ, "PYTHONPATH": str(tmp_path / "worker")}
    command = [sys.executable, "-m", "lampblack.protocol.documents"]
    subprocess.run(command, check=True, timeout=120, env=environment, cwd=tmp_path)

    def added(name: str) -> list[str]:
        before, after = ((root / name).read_text().splitlines() for root in (ROOT, tmp_path))
        return [" ".join(row.split()) for row in after if row not in before]

    generated = "pencil2d_plugin/scene/generated"
    assert added(f"{generated}/scene_types.h") == ["double exposure = 0; ///< stops, -8 to 8"]
    assert added(f"{generated}/scene_fields.h") == [
        'fields.real("exposure", value.exposure, -8, 8, Need::Optional);'
    ]
    assert "a.exposure" in "".join(added(f"{generated}/scene_types.cpp"))
    assert '"exposure": {' in added("protocol/scene.schema.json")
