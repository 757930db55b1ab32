"""Lights and floors between their keys."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from lampblack.colour import hex_linear
from lampblack.errors import SceneError
from lampblack.scene import (
    MAX_KEYS,
    AreaLight,
    Floor,
    FloorKey,
    LightKey,
    Scene,
    decode_scene,
    default_scene,
    encode_scene,
)
from lampblack.timeline import is_keyed, scene_at

FIRST = LightKey(frame=10, x=0, y=40, z=-20, size=100, colour="#000000", power=0.5)
LAST = LightKey(frame=20, x=100, y=-40, z=80, size=300, colour="#ffffff", power=2.5)


def keyed(*keys: LightKey) -> Scene:
    light = AreaLight(7, 7, 7, keys=keys)
    floor = Floor(3, keys=(FloorKey(20, 80, 45), FloorKey(10, 40, 25)))
    return replace(default_scene(100, 80), lights=(light,), floor=floor)


def test_values_are_linear_between_keys_and_held_outside() -> None:
    scene = keyed(LAST, FIRST)
    for frame, share in ((1, 0.0), (10, 0.0), (11, 0.1), (15, 0.5), (20, 1.0), (500, 1.0)):
        still = scene_at(scene, frame)
        light, floor = still.lights[0], still.floor
        assert not is_keyed(still)
        assert floor is not None
        for name in ("x", "y", "z", "size", "power"):
            low, high = getattr(FIRST, name), getattr(LAST, name)
            assert getattr(light, name) == pytest.approx(low + share * (high - low))
        assert (floor.y, floor.pitch) == pytest.approx((40 + 40 * share, 25 + 20 * share))
        # Half way from black to white is half the light, not half the sRGB value.
        assert hex_linear(light.colour) == pytest.approx(np.full(3, share), abs=0.005)


def test_a_scene_without_keys_is_itself_at_every_frame() -> None:
    scene = default_scene(100, 80)
    assert scene_at(scene, 7) is scene
    assert "keys" not in json.loads(encode_scene(scene))["lights"][0]


def test_one_key_holds_and_of_two_at_one_frame_the_last_counts() -> None:
    assert scene_at(keyed(LAST), 3).lights[0].x == LAST.x
    assert scene_at(keyed(FIRST, replace(LAST, frame=10)), 10).lights[0].x == LAST.x


def test_keys_go_to_json_and_back_with_what_is_unknown() -> None:
    scene = keyed(FIRST, LAST)
    tree = json.loads(encode_scene(scene))
    tree["lights"][0]["keys"][1]["ease"] = "out"
    again = decode_scene(json.dumps(tree).encode())
    assert json.loads(encode_scene(again)) == tree
    assert decode_scene(encode_scene(scene)) == scene


@pytest.mark.parametrize(
    "key",
    [
        {"frame": -1, "x": 0, "y": 0, "z": 0},
        {"frame": 1.5, "x": 0, "y": 0, "z": 0},
        {"frame": 1, "x": 0, "y": 0},
        {"frame": 1, "x": 1e9, "y": 0, "z": 0},
        {"frame": 1, "x": 0, "y": 0, "z": 0, "power": -1},
        {"frame": 1, "x": 0, "y": 0, "z": 0, "colour": "red"},
    ],
)
def test_keys_out_of_range_are_refused(key: dict[str, object]) -> None:
    tree = json.loads(encode_scene(default_scene(100, 80)))
    tree["lights"][0]["keys"] = [key]
    with pytest.raises(SceneError):
        decode_scene(json.dumps(tree).encode())


def test_too_many_keys_are_refused() -> None:
    keys = tuple(replace(FIRST, frame=frame) for frame in range(MAX_KEYS + 1))
    assert decode_scene(encode_scene(keyed(*keys[1:]))).lights[0].keys == keys[1:]
    with pytest.raises(SceneError):
        decode_scene(encode_scene(keyed(*keys)))
