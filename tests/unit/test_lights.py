"""Lights that are off, solo, named, or suns: what is traced, what is shown, what is kept."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lampblack.composite.illumination import Illumination
from lampblack.render.light_pass_cache import LightPassCache
from lampblack.render.passes import LightPasses, Passes
from lampblack.scene import (
    MAX_KEYS,
    MAX_LIGHTS,
    Ambient,
    AreaLight,
    LightKey,
    Scene,
    decode_scene,
    default_scene,
    encode_scene,
    shining,
)
from lampblack.timeline import scene_at
from support.drawings import draw_ball
from support.preview_fakes import Stage

LIGHTS = tuple(AreaLight(x, 20, 40, 30) for x in (10, 30, 50))
ONE = b"one"


def scene(*lights: AreaLight) -> Scene:
    return replace(default_scene(64, 64), lights=lights, ambient=Ambient(strength=0))


@pytest.mark.parametrize(
    ("changes", "shown"),
    [
        ((), (True, True, True)),
        (({"on": False},), (False, True, True)),
        (({}, {"solo": True}), (False, True, False)),
        (({"solo": True}, {"solo": True}), (True, True, False)),
        (({"on": False, "solo": True},), (False, True, True)),
    ],
)
def test_only_lights_that_are_on_shine_and_only_solo_ones_if_there_are_any(
    changes: tuple[dict[str, bool], ...], shown: tuple[bool, ...]
) -> None:
    changed = [replace(light, **fields) for light, fields in zip(LIGHTS, changes, strict=False)]
    lights = (*changed, *LIGHTS[len(changed) :])
    assert tuple(shining(lights)) == shown


def plain(value: float) -> LightPasses:
    return LightPasses(*(np.full((1, 1, 3), value, np.float32) for _ in range(2)))


def test_finals_trace_no_light_that_is_off_and_keep_it_for_when_it_is_on() -> None:
    traced: list[float] = []

    def trace(asked: Scene, ambient: bool, glows: object) -> Passes:
        traced.extend(light.x for light in asked.lights)
        return Passes(tuple(plain(light.x) for light in asked.lights), plain(0))

    cache, drawing = LightPassCache(), object()
    first, second, third = LIGHTS

    def light_of(*lights: AreaLight) -> float:
        shown = scene(*lights)
        return float(Illumination.of(cache.complete(drawing, shown, trace), shown).diffuse[0, 0, 0])

    assert light_of(first, replace(second, on=False), third) == 60
    assert traced == [10, 50]
    assert light_of(first, second, third) == 90
    assert light_of(first, replace(second, solo=True), third) == 30
    assert light_of(replace(first, on=False), second, third) == 80
    assert light_of(first, second, third) == 90
    assert traced == [10, 50, 30]


def test_a_preview_shows_a_light_again_without_a_trace(tmp_path: Path) -> None:
    stage = Stage(tmp_path)
    stage.greet(ONE)
    stage.announce(ONE, 1, draw_ball(64))
    first, second = LIGHTS[:2]
    stage.set_scene(ONE, scene(first, replace(second, on=False)))
    stage.look(ONE, 1, 64)
    stage.settle()
    assert {job.light and job.light.x for job in stage.renderer.jobs} == {10}
    one = stage.picture(ONE).copy()
    stage.set_scene(ONE, scene(first, second))
    stage.settle()
    assert {job.light and job.light.x for job in stage.renderer.jobs} == {10, 30}
    both = stage.picture(ONE).copy()
    assert both[32, 32].astype(int).sum() > one[32, 32].astype(int).sum()
    stage.renderer.jobs.clear()
    for lights, expected in (
        ((first, replace(second, on=False)), one),
        ((first, second), both),
        ((replace(first, solo=True), second), one),
        ((first, replace(second, name="fill")), both),
    ):
        stage.set_scene(ONE, scene(*lights))
        stage.settle()
        assert np.array_equal(stage.picture(ONE), expected)
    assert stage.renderer.jobs == []


def test_a_preview_traces_a_lamp_that_becomes_a_sun(tmp_path: Path) -> None:
    stage = Stage(tmp_path)
    stage.greet(ONE)
    stage.announce(ONE, 1, draw_ball(64))
    stage.set_scene(ONE, scene(LIGHTS[0]))
    stage.look(ONE, 1, 64)
    stage.settle()
    stage.renderer.jobs.clear()
    stage.set_scene(ONE, scene(replace(LIGHTS[0], kind="sun")))
    stage.settle()
    assert {job.light and job.light.kind for job in stage.renderer.jobs} == {"sun"}


def test_a_sun_moves_between_its_keys() -> None:
    keys = (LightKey(1, 0, 0, 100), LightKey(11, 100, 50, 200, power=3))
    moved = scene_at(scene(AreaLight(0, 0, 1, kind="sun", name="dusk", keys=keys)), 6).lights[0]
    assert (moved.x, moved.y, moved.z, moved.power) == (50, 25, 150, 2)
    assert (moved.kind, moved.name, moved.keys) == ("sun", "dusk", ())


def test_the_new_fields_survive_a_file_and_may_be_missing() -> None:
    light = AreaLight(1, 2, 3, kind="sun", name="Sünne", on=False, solo=True)
    assert decode_scene(encode_scene(scene(light))).lights == (light,)
    old = decode_scene(b'{"canvas":{"width":9,"height":9},"lights":[{"x":1,"y":2,"z":3}]}')
    assert old.lights == (AreaLight(1, 2, 3),)
    assert (old.lights[0].kind, old.lights[0].on, old.lights[0].solo) == ("lamp", True, False)


def test_as_many_lights_with_as_many_keys_as_there_may_be_fit_into_one_message() -> None:
    from lampblack.protocol import SetScene, encode

    key = LightKey(123456, -12345.6789, -12345.6789, -12345.6789, 12345.6789, "#abcdef", 12.3456789)
    light = replace(LIGHTS[0], name="x" * 80, keys=(key,) * MAX_KEYS)
    (header,) = encode(SetScene(revision=1, scene=scene(*(light,) * MAX_LIGHTS)))
    assert len(header) < 300_000
