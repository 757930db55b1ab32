"""Styles: looks that come with Lampblack, in files, and on other canvases."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from lampblack.errors import SceneError
from lampblack.finals.scene_overrides import SceneOverrides
from lampblack.looks import PRESETS, find_style, preset, preset_name, with_style
from lampblack.rigs import with_rig
from lampblack.scene import (
    Canvas,
    Look,
    Rig,
    Rim,
    Style,
    decode_rig,
    decode_style,
    default_scene,
    encode_rig,
    encode_style,
)


def test_each_style_is_another_look_and_the_first_is_the_default() -> None:
    looks = [(preset(name).look, preset(name).rim) for name in PRESETS]
    assert looks[0] == (Look(), None)
    assert all(a != b for i, a in enumerate(looks) for b in looks[:i])
    assert [preset(name).name for name in PRESETS] == [
        "Smooth",
        "Soft cel",
        "Hard cel",
        "Two-tone + rim",
    ]
    assert [preset_name(preset(name).name) for name in PRESETS] == list(PRESETS)


def test_a_style_replaces_look_and_rim_and_the_rim_grows_with_the_canvas() -> None:
    scene = replace(default_scene(500, 250), rim=Rim(width=3))
    styled = with_style(scene, preset("two-tone-rim"))
    rim = preset("two-tone-rim").rim
    assert rim is not None
    assert styled == replace(
        scene, look=preset("two-tone-rim").look, rim=replace(rim, width=rim.width / 2)
    )
    assert with_style(styled, preset("hard-cel")).rim is None
    assert SceneOverrides(style=preset("hard-cel")).scene(Canvas(9, 9)).look.tones


def test_a_rig_may_have_a_look() -> None:
    scene = replace(default_scene(200, 200), rim=Rim(width=3), look=Look(contact=0.5))
    lights = Rig(Canvas(100, 100))
    assert with_rig(scene, lights).look == scene.look
    assert with_rig(scene, lights).rim == scene.rim
    styled = replace(lights, look=Look(tones=(0.5,)), rim=Rim(width=2))
    assert with_rig(scene, styled).rim == Rim(width=4)
    assert decode_rig(encode_rig(styled)) == styled


def test_styles_in_files(tmp_path: Path) -> None:
    own = Style(Canvas(100, 80), "Mine", Look(tones=(0.3, 0.6)), Rim(colour="#00ff00"))
    path = tmp_path / "mine.json"
    path.write_bytes(encode_style(own))
    assert find_style(str(path)) == decode_style(encode_style(own)) == own
    assert find_style("Two-Tone + Rim") == preset("two-tone-rim")
    for wrong in (b"{", b'{"version": 2}', b'{"canvas": {"width": 0, "height": 1}}'):
        path.write_bytes(wrong)
        with pytest.raises(SceneError):
            find_style(str(path))
    with pytest.raises(SceneError, match="no look"):
        find_style("sepia")
