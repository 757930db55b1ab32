"""The plugin's codec and scene against the worker's: one verdict on every message and file.

Needs the plugin's conformance program, which the build makes: ``cmake --preset dev`` and
``cmake --build --preset dev``. ``LAMPBLACK_BUILD`` names another build folder.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lampblack.errors import SceneError
from lampblack.protocol import CATALOGUE, decode
from lampblack.protocol.conformance import understood
from lampblack.protocol.version import PREFIX
from lampblack.scene import (
    AreaLight,
    Floor,
    FloorKey,
    LightKey,
    Scene,
    decode_scene,
    default_scene,
    encode_scene,
)
from lampblack.timeline import scene_at
from support.conformance import VECTORS, cases, differs, expectation, frames_of, verdict
from support.paths import BUILD

PROGRAM = BUILD / "tests" / "plugin" / "protocol" / "lampblack_conformance"
MUTANTS = 3000
ACCEPT = [case for case in cases() if case.parent.name == "accept"]

TEXT_CODES = {"bad_json", "bad_number"}
"""A parser may find either first where a header has both faults (SPEC 3.4)."""

SCENES = {
    "default": encode_scene(default_scene(1280, 720)),
    "least": b'{"canvas": {"width": 1, "height": 1}}',
    "numbers": b"""{"canvas": {"width": 1000, "height": 65536}, "relief_scale": 1e-2, "lights": [
        {"x": -0.0, "y": 0.1, "z": -1e5, "size": 1, "power": 99.99999999999999}]}""",
    "everything": """{"canvas": {"width": 640, "height": 480, "dpi": 72},
        "lights": [{"x": 1, "y": 2, "z": 3, "colour": "#00ff7f", "gobo": {"f": "\u00e9\\u0000"}}],
        "ambient": {"colour": "#010203", "strength": 0, "map": null}, "default_material": {"a": 1},
        "materials": {"#dd3f2e": {"glossy": true, "sheen": 0.1}, "#000000": {"diffuse": false}},
        "floor": {"y": 411.5, "f": []}, "quality": "final", "version": 1,
        "pencil2d_layers": {"Figur": "character"}, "extra": {"extra": 1}}""".encode(),
}
NO_SCENES = {
    "empty": b"",
    "array": b"[]",
    "no canvas": b"{}",
    "version": b'{"canvas": {"width": 8, "height": 8}, "version": 2}',
    "true for a version": b'{"canvas": {"width": 8, "height": 8}, "version": true}',
    "no number": b'{"canvas": {"width": "8", "height": 8}}',
    "null": b'{"canvas": {"width": 8, "height": 8}, "ambient": null}',
    "material": b'{"canvas": {"width": 8, "height": 8}, "materials": {"#FFFFFF": {}}}',
    "comment": b'{"canvas": {"width": 8, "height": 8} /* mine */}',
    "too long": b'{"canvas": {"width": 8, "height": 8}}' + b" " * (1 << 20),
}


@pytest.fixture(scope="session")
def program() -> str:
    if not PROGRAM.exists():
        pytest.skip(f"the plugin's tests are not built: there is no {PROGRAM}")
    return str(PROGRAM)


def run(*arguments: str | Path) -> list[Any]:
    """What the program prints, a JSON value a line."""
    ran = subprocess.run(list(map(str, arguments)), check=True, timeout=120, stdout=subprocess.PIPE)
    return [json.loads(line) for line in ran.stdout.splitlines()]


def test_every_vector(program: str) -> None:
    found = run(program, *cases())
    assert len(found) == len(cases())
    assert [
        fault for case, f in zip(cases(), found, strict=True) if (fault := differs(case, f))
    ] == []


def test_every_fault_of_every_field(program: str, tmp_path: Path) -> None:
    make = [sys.executable, str(VECTORS.parent / "make_vectors.py"), str(tmp_path), "--every-fault"]
    subprocess.run(make, check=True, timeout=120)
    every = cases(tmp_path)
    found = run(program, *every)
    assert [
        fault for case, f in zip(every, found, strict=True) if (fault := differs(case, f))
    ] == []


def test_mutants_are_judged_alike(program: str, tmp_path: Path) -> None:
    run(program, "--mutate", VECTORS, tmp_path, str(MUTANTS), "7")
    folders = sorted(tmp_path.iterdir())
    ours = [verdict(folder) for folder in folders]
    theirs = run(program, *folders)
    assert disagreements(folders, ours, theirs) == []
    codes = {v["code"] for v in ours if "code" in v}
    decoding = {code.value for code, entry in CATALOGUE.items() if entry.decoding}
    assert len(codes) >= 14
    assert codes <= decoding
    assert sum("message" in v for v in ours) > MUTANTS / 5


def disagreements(
    folders: Sequence[Path], ours: Sequence[dict[str, Any]], theirs: Sequence[dict[str, Any]]
) -> list[str]:
    """Mutants that the two accept, understand or refuse differently."""
    return [
        f"{folder.name}: {a} / {b}"
        for folder, a, b in zip(folders, ours, theirs, strict=True)
        if a != b
        and not (a.get("code") in TEXT_CODES and b.get("code") in TEXT_CODES)
        and not _begins_with_a_byte_order_mark(folder)
    ]


def _begins_with_a_byte_order_mark(folder: Path) -> bool:
    """Whether a text of the mutant does: Qt drops the mark there, and Python keeps it."""
    header = folder / "header.json"
    return header.is_file() and b'"\xef\xbb\xbf' in header.read_bytes()


@pytest.mark.parametrize("case", ACCEPT, ids=lambda case: case.name)
def test_what_the_plugin_writes(program: str, tmp_path: Path, case: Path) -> None:
    run(program, "--encode", case, tmp_path)
    sender = expectation(case)["sender"]
    again = decode(frames_of(tmp_path), sender)
    assert understood(again) == verdict(case)
    assert (tmp_path / "header.json").read_bytes().startswith(PREFIX)


@pytest.mark.parametrize("name", SCENES)
def test_scene_files_are_read_alike(program: str, tmp_path: Path, name: str) -> None:
    file = tmp_path / "scene.json"
    file.write_bytes(SCENES[name])
    assert run(program, "--scene", file) == [json.loads(encode_scene(decode_scene(SCENES[name])))]


@pytest.mark.parametrize("name", SCENES)
def test_scene_files_survive_both(program: str, tmp_path: Path, name: str) -> None:
    ours = decode_scene(SCENES[name])
    (tmp_path / "from.json").write_bytes(encode_scene(ours))
    run(program, "--copy-scene", tmp_path / "from.json", tmp_path / "to.json")
    theirs: Scene = decode_scene((tmp_path / "to.json").read_bytes())
    assert theirs == ours


@pytest.mark.parametrize("name", NO_SCENES)
def test_scene_files_are_refused_alike(program: str, tmp_path: Path, name: str) -> None:
    file = tmp_path / "scene.json"
    file.write_bytes(NO_SCENES[name])
    with pytest.raises(SceneError):
        decode_scene(NO_SCENES[name])
    assert list(run(program, "--scene", file)[0]) == ["fault"]


def test_keyed_scenes_are_alike_at_every_frame(program: str, tmp_path: Path) -> None:
    """Every number to its last bits, every colour to the byte."""
    rng = np.random.default_rng(11)

    def key(frame: int) -> LightKey:
        x, y, z = rng.uniform(-500, 500, 3).tolist()
        size, power = rng.uniform(1, 9, 2).tolist()
        return LightKey(frame, x, y, z, size, "#" + rng.bytes(3).hex(), power)

    frames = range(1, 500)
    lights = tuple(
        AreaLight(0, 0, 0, keys=tuple(map(key, rng.permutation(frames)[:count].tolist())))
        for count in (2, 7, 40, 128)
    )
    floor = Floor(0, keys=(FloorKey(400, 1 / 3), FloorKey(3, 0.7), FloorKey(90, 9.1, 80)))
    scene = replace(default_scene(640, 480), lights=lights, floor=floor)
    file = tmp_path / "scene.json"
    file.write_bytes(encode_scene(scene))
    theirs = run(program, "--scene-at", file, *map(str, frames))
    ours = [json.loads(encode_scene(scene_at(scene, frame))) for frame in frames]
    assert theirs == ours


def test_default_scenes_are_the_same(program: str) -> None:
    for width, height in ((1280, 720), (1, 1), (333, 4096)):
        expected = json.loads(encode_scene(default_scene(width, height)))
        assert run(program, "--default-scene", str(width), str(height)) == [expected]
