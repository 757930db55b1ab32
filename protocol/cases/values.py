"""Messages to refuse for what they mean: scenes, cameras, frame lists, outputs."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from lampblack.scene import MAX_KEYS

from .case import Case, Tree, patched
from .samples import DRAWING, LIGHT, PIXELS, RENDER, SCENE, SET_SCENE, put_frame

PLACE = {"x": 0, "y": 0, "z": 0}


def keyed(keys: Any) -> Tree:
    """A scene with these keys of a light."""
    return {**SCENE, "lights": [{**LIGHT, "keys": keys}]}


def floor_keyed(keys: Any) -> Tree:
    """A scene with these keys of a floor."""
    return {**SCENE, "floor": {"y": 1, "keys": keys}}


def rejected_scenes() -> Iterator[Case]:
    """Scenes that cannot be used."""
    for name, scene in {
        "null": None,
        "array": [],
        "without-canvas": {"lights": []},
        "version-2": {**SCENE, "version": 2},
        "nine-lights": {**SCENE, "lights": [LIGHT] * 9},
        "600-lights": {**SCENE, "lights": [LIGHT] * 600},
        "light-too-far": {**SCENE, "lights": [{**LIGHT, "x": 100000.5}]},
        "light-nan-as-text": {**SCENE, "lights": [{**LIGHT, "x": "NaN"}]},
        "light-null": {**SCENE, "lights": [{**LIGHT, "x": None}]},
        "light-colour": {**SCENE, "lights": [{**LIGHT, "colour": "#FFF"}]},
        "power-negative": {**SCENE, "lights": [{**LIGHT, "power": -1}]},
        "material-key": {**SCENE, "materials": {"red": {}}},
        "gloss-above-1": {**SCENE, "default_material": {"gloss": 1.5}},
        "floor-edge-on": {**SCENE, "floor": {"y": 1, "pitch": 0}},
        "keys-null": keyed(None),
        "keys-object": keyed({}),
        "key-number": keyed([12]),
        "key-frame-missing": keyed([PLACE]),
        "key-frame-negative": keyed([{**PLACE, "frame": -1}]),
        "key-frame-large": keyed([{**PLACE, "frame": 1000000}]),
        "key-frame-fraction": keyed([{**PLACE, "frame": 1.5}]),
        "key-place-missing": keyed([{"frame": 1, "x": 0, "y": 0}]),
        "key-too-far": keyed([{**PLACE, "frame": 1, "z": -100000.5}]),
        "key-size-0": keyed([{**PLACE, "frame": 1, "size": 0}]),
        "key-colour": keyed([{**PLACE, "frame": 1, "colour": "#ABCDEF"}]),
        "key-power-large": keyed([{**PLACE, "frame": 1, "power": 100.5}]),
        "129-keys": keyed([{**PLACE, "frame": frame} for frame in range(MAX_KEYS + 1)]),
        "floor-key-place-missing": floor_keyed([{"frame": 1}]),
        "floor-key-frame-missing": floor_keyed([{"y": 1}]),
        "floor-key-edge-on": floor_keyed([{"frame": 1, "y": 1, "pitch": 4.5}]),
        "floor-129-keys": floor_keyed([{"frame": f, "y": 1} for f in range(MAX_KEYS + 1)]),
        "quality-unknown": {**SCENE, "quality": "best"},
        "canvas-fraction": {"canvas": {"width": 640.5, "height": 480}},
    }.items():
        yield Case(f"scene-{name}", "client", patched(SET_SCENE, scene=scene), code="bad_scene")
    missing = {name: value for name, value in SET_SCENE.items() if name != "scene"}
    yield Case("field-set_scene-scene-missing", "client", missing, code="bad_field")


def rejected_values() -> Iterator[Case]:
    """Fields that are sound alone."""
    for name, camera in {
        "zero": [0, 0, 0, 0, 0, 0],
        "flat": [1, 2, 0, 2, 4, 0],
        "nearly-flat": [0.0009, 0, 0, 0, 0.001, 0],
    }.items():
        tree = put_frame(DRAWING, camera=camera)
        yield Case(f"camera-{name}", "client", tree, (PIXELS.tobytes(),), "bad_value")
    for name, frames in {
        "backwards": "1-3,20-10",
        "step-0": "1-20x0",
        "too-many": "0-99999,200000",
    }.items():
        yield Case(f"frames-{name}", "client", {**RENDER, "frames": frames}, code="bad_value")
    for name, output in {
        "relative": "shots/a.%04d.png",
        "without-number": "/shots/a.png",
        "two-numbers": "/shots/%04d/a.%04d.png",
        "other-conversion": "/shots/a.%s.%04d.png",
        "nul": "/shots/a\0.%04d.png",
        "other-kind": "/shots/a.%04d.exe",
    }.items():
        yield Case(f"output-{name}", "client", {**RENDER, "output": output}, code="bad_field")
