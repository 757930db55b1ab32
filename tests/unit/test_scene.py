"""The scene: JSON in and out, unknown fields kept, nonsense refused."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from lampblack.errors import SceneError
from lampblack.scene import (
    Floor,
    Material,
    decode_scene,
    default_scene,
    encode_scene,
)

SCENE = replace(
    default_scene(1000, 800),
    floor=Floor(y=900.0),
    materials={"#ff0000": Material(glossy=True), "#00ff00": Material(diffuse=False)},
)


def test_round_trip() -> None:
    assert decode_scene(encode_scene(SCENE)) == SCENE


def test_unknown_fields_survive_at_every_depth() -> None:
    tree = json.loads(encode_scene(SCENE))
    tree["mood"] = {"name": "dusk"}
    tree["lights"][0]["gobo"] = [1, {"deep": None}]
    tree["floor"]["wet"] = True
    tree["materials"]["#ff0000"]["sheen"] = 0.5
    again = json.loads(encode_scene(decode_scene(json.dumps(tree).encode())))
    assert again == tree


def test_materials_follow_the_colour_not_the_order() -> None:
    swapped = replace(SCENE, materials=dict(reversed(SCENE.materials.items())))
    assert decode_scene(encode_scene(swapped)).material("#ff0000") == Material(glossy=True)
    assert SCENE.material("#123456") == SCENE.default_material


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("version", 2),
        ("version", "1"),
        ("canvas", {"width": 0, "height": 5}),
        ("canvas", {"width": 1e9, "height": 5}),
        ("canvas", None),
        ("lights", [{"x": 1, "y": 2}]),
        ("lights", [{"x": 1e30, "y": 2, "z": 3}]),
        ("lights", [{"x": 1, "y": 2, "z": 3}] * 9),
        ("lights", [{"x": 1, "y": 2, "z": 3, "colour": "#FFF"}]),
        ("lights", [{"x": 1, "y": 2, "z": 3, "power": -1}]),
        ("ambient", {"colour": "#ffffff\n"}),
        ("materials", {"red": {}}),
        ("materials", {"#ff0000": {"gloss": 2}}),
        ("floor", {"y": 3, "pitch": 0}),
        ("floor", 7),
        ("relief_scale", "NaN"),
        ("quality", "best"),
        ("quality", ["low"] * 3),
    ],
)
def test_out_of_range_is_refused(path: str, value: object) -> None:
    tree = json.loads(encode_scene(SCENE))
    tree[path] = value
    with pytest.raises(SceneError):
        decode_scene(json.dumps(tree).encode())


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"{",
        b"[]",
        b"\xff\xfe",
        b"{}",
        b'{"canvas": {"width": 9, "height": 9}, "relief_scale": NaN}',
        b'{"canvas": {"width": 9, "height": 9}, "relief_scale": 1e999}',
        b"[" * 100_000,
        b" " * (2 << 20),
    ],
)
def test_not_a_scene_is_refused(data: bytes) -> None:
    with pytest.raises(SceneError):
        decode_scene(data)
