"""The live worker's parts that need neither socket nor renderer."""

from __future__ import annotations

import threading
import warnings
from dataclasses import replace

import numpy as np
import pytest

from lampblack.camera import IDENTITY, scene_in_view
from lampblack.composite.byte_layers import premultiplied
from lampblack.drawing import DrawingPlanes
from lampblack.errors import LampblackWarning
from lampblack.lasting import lasting_thread
from lampblack.pipeline import Pipeline
from lampblack.prepared import PreparedDrawing
from lampblack.preview import Viewport, ViewRequest
from lampblack.preview.bounded import BoundedStore
from lampblack.preview.contribution import LightContribution, preview_surface
from lampblack.preview.light_store import AccumulatedLight, LightStore
from lampblack.preview.shape import DrawingShape
from lampblack.scene import Depth, DepthHint, DepthPoint, Floor, Material, Scene, default_scene
from lampblack.service.outbox import MAX_WAITING, Outbox
from lampblack.service.overlaps import overlaps_on_canvas
from lampblack.surface import check_relief
from lampblack.surface.overlap import Overlap
from lampblack.warning_collector import collect_warnings, install_warning_collector
from support.drawings import draw_ball

SIZE = 160
VIEWPORT = Viewport(1, 1, "lit", (0.0, 0.0, float(SIZE), float(SIZE)), (SIZE, SIZE))


@pytest.fixture(scope="module")
def drawing(pipeline: Pipeline) -> PreparedDrawing:
    return pipeline.prepare_quick(DrawingPlanes(draw_ball(SIZE)), "ball").compact()


def test_the_least_lately_used_goes_first() -> None:
    store: BoundedStore[str, int] = BoundedStore(100)
    for number, key in enumerate("abc"):
        store.put(key, number, 40)
        store.get("a")
    assert store.get("b") is None
    assert (store.get("a"), store.get("c"), store.nbytes) == (0, 2, 80)
    store.put("large", 9, 1000)
    assert len(store) == 1
    store.keep(set())
    assert store.nbytes == 0


def test_one_picture_waits_and_everything_else_stays() -> None:
    outbox = Outbox()
    for number in range(5):
        outbox.put([b"picture %d" % number], picture=True)
        outbox.put([b"word %d" % number])
    sent = []
    while (frames := outbox.first()) is not None:
        sent.append(frames[0])
        outbox.sent()
    assert sent == [b"word 0", b"word 1", b"word 2", b"word 3", b"picture 4", b"word 4"]
    for _ in range(MAX_WAITING + 1):
        assert not outbox.overflows
        outbox.put([b""])
    assert outbox.overflows


def test_warnings_are_heard_by_their_own_thread_alone() -> None:
    heard: dict[str, list[str]] = {}
    barrier = threading.Barrier(2)

    def warn(sentence: str) -> None:
        with collect_warnings() as found:
            barrier.wait()
            warnings.warn(sentence, LampblackWarning, stacklevel=1)
            barrier.wait()
        heard[sentence] = found

    with warnings.catch_warnings():
        install_warning_collector()
        threads = [threading.Thread(target=warn, args=(word,)) for word in ("one", "two")]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert heard == {"one": ["one"], "two": ["two"]}


def test_a_quick_drawing_is_a_closed_dome_in_register(drawing: PreparedDrawing) -> None:
    relief = preview_surface(drawing, default_scene(SIZE, SIZE)).relief
    assert check_relief(relief) == []
    x, y, z = relief.vertices[: relief.front].T
    for along in (x, y):  # vertices are closer together where the surface bends
        assert abs((along.min() + along.max()) / 2 - SIZE / 2) < 1
    assert z[np.hypot(x - 80, y - 80) < 8].mean() == pytest.approx(64, rel=0.3)
    left, top, width, height = drawing.box
    assert left < 17 < 143 < left + width
    assert top < 17 < 143 < top + height


def test_a_quick_drawing_knows_the_lines(pipeline: Pipeline) -> None:
    """What is shown first is no mere dome: it is predicted, like what follows."""
    plain = draw_ball(SIZE)
    split = plain.copy()
    split[78:82, 30:130] = 0, 0, 0, 255
    one, other = (
        127.5 * pipeline.prepare_quick(DrawingPlanes(pixels)).normals for pixels in (plain, split)
    )
    assert one.shape == other.shape
    assert np.abs(one - other)[20:60, 20:60].mean() > 3


def test_the_camera_takes_the_scene_along() -> None:
    scene = replace(default_scene(100, 80), floor=Floor(70.0))
    assert scene_in_view(scene, IDENTITY, (100, 80)) == scene
    seen = scene_in_view(scene, (2, 0, 30, 0, 2, -10), (300, 200))
    light, before = seen.lights[0], scene.lights[0]
    assert (light.x, light.y) == (2 * before.x + 30, 2 * before.y - 10)
    assert (light.z, light.size) == (2 * before.z, 2 * before.size)
    assert seen.floor is not None
    assert seen.floor.y == 130
    assert seen.canvas.default_height == 2 * scene.canvas.default_height


def test_the_camera_takes_the_hints_along() -> None:
    points = (DepthPoint(10.0, 20.0), DepthPoint(30.0, 20.0))
    hint = DepthHint(3, points, front="left", amount=0.1)
    scene = replace(default_scene(100, 80), depth=Depth(hints=(hint,)))
    seen = scene_in_view(scene, (2, 0, 30, 0, 2, -10), (300, 200)).depth.hints[0]
    assert [(p.x, p.y) for p in seen.points] == [(50, 30), (90, 30)]
    assert (seen.front, seen.amount, seen.frame) == ("left", 0.1, 3)
    mirrored = scene_in_view(scene, (-1, 0, 100, 0, 1, 0), (100, 80)).depth.hints[0]
    assert [p.x for p in mirrored.points] == [90, 70]
    assert mirrored.front == "right"


def test_overlaps_are_sent_in_pixels_of_the_canvas() -> None:
    points = np.stack([np.linspace(50, 90, 99), np.full(99, 30.0)], axis=1).astype(np.float32)
    overlap = Overlap(points, "left", 8.0, hinted=True)
    (sent,) = overlaps_on_canvas([overlap], (2, 0, 30, 0, 2, -10))
    assert len(sent.points) == 32
    assert [(p.x, p.y) for p in (sent.points[0], sent.points[-1])] == [(10, 20), (30, 20)]
    assert (sent.front, sent.amount, sent.hinted) == ("left", 4.0, True)
    (mirrored,) = overlaps_on_canvas([overlap], (-1, 0, 100, 0, 1, 0))
    assert mirrored.front == "right"
    assert len(overlaps_on_canvas([overlap] * 500, IDENTITY)) == 128


def test_a_change_invalidates_exactly_what_it_shapes(drawing: PreparedDrawing) -> None:
    scene = default_scene(SIZE, SIZE)
    scene = replace(scene, lights=(scene.lights[0], replace(scene.lights[0], x=100.0)))
    colour = drawing.layers.palette.swatches[0].colour
    shiny = {colour: Material(glossy=True, gloss=0.4)}
    scene = replace(scene, materials=shiny)
    store = LightStore()
    light = np.zeros((2, 2, 3), np.float32)

    def contributions(changed: Scene) -> tuple[LightContribution, ...]:
        shape = DrawingShape("ball")
        view = ViewRequest("", VIEWPORT, shape, IDENTITY, 1, changed).resolve(drawing)
        assert view is not None
        return view.contributions

    for contribution in contributions(scene):
        store.put(contribution, AccumulatedLight(2, 8, contribution.amounts, light, light))

    def levels(changed: Scene) -> list[int]:
        return [store.level(contribution) for contribution in contributions(changed)]

    first, second = scene.lights
    assert levels(scene) == [2, 2, 2]
    assert levels(replace(scene, lights=(replace(first, colour="#ff0000", power=3.0), second))) == [
        2,
        2,
        2,
    ]
    assert levels(replace(scene, lights=(replace(first, x=5.0), second))) == [-1, 2, 2]
    assert levels(replace(scene, lights=(second, first))) == [2, 2, 2]
    assert levels(replace(scene, lights=(first, replace(second, power=0.0)))) == [2, 2]
    softer = {colour: Material(glossy=True, gloss=0.5)}
    assert levels(replace(scene, materials=softer)) == [0, 0, 0]
    rougher = {colour: Material(glossy=True, gloss=0.4, roughness=0.9)}
    assert levels(replace(scene, materials=rougher)) == [-1, -1, -1]
    assert levels(replace(scene, relief_scale=2.0)) == [-1, -1, -1]
    assert levels(replace(scene, floor=Floor(150.0))) == [-1] * 6
    store.keep(contributions(replace(scene, lights=(first,))))
    assert levels(scene) == [2, -1, 2]


def test_premultiplied_and_back_in_register() -> None:
    picture = draw_ball(SIZE)
    found = premultiplied(picture)
    assert np.array_equal(found[..., 3], picture[..., 3])
    assert (found[..., :3] <= found[..., 3:]).all()


def test_a_thread_survives_what_its_work_did_not_expect(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("lampblack.lasting.PAUSE_SECONDS", 0.0)
    told: list[Exception] = []
    runs: list[int] = []

    def run() -> None:
        runs.append(1)
        if len(runs) < 3:
            raise KeyError(len(runs))

    thread = lasting_thread("Work", run, told.append)
    thread.start()
    thread.join(5)
    assert not thread.is_alive()
    assert [type(error) for error in told] == [KeyError, KeyError]
    assert len(runs) == 3
