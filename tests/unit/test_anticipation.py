"""Light that is shown before it is traced."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from lampblack.camera import IDENTITY
from lampblack.drawing import DrawingPlanes
from lampblack.pipeline import Pipeline
from lampblack.prepared import PreparedDrawing
from lampblack.preview import PreviewState, Viewport, ViewRequest
from lampblack.preview.anticipation import LONGEST, MOST_ADDED, Anticipation
from lampblack.preview.contribution import LightContribution
from lampblack.preview.light_store import AccumulatedLight, LightStore
from lampblack.preview.painter import Painter, PreviewImage
from lampblack.preview.refinement import CONVERGED
from lampblack.preview.shape import DrawingShape
from lampblack.preview.sketch import SketchedSurface, grey
from lampblack.scene import AreaLight, Scene, default_scene
from support.drawings import draw_ball

SIZE = 160
WHOLE = (0.0, 0.0, float(SIZE), float(SIZE))
BOUNCED = 0.05


@pytest.fixture(scope="module")
def drawing(pipeline: Pipeline) -> PreparedDrawing:
    return pipeline.prepare_quick(DrawingPlanes(draw_ball(SIZE)), "ball").compact()


def lit_from(x: float, **changes: object) -> Scene:
    scene = default_scene(SIZE, SIZE)
    light = replace(scene.lights[0], x=x, y=30.0, z=60.0, size=20.0)
    return replace(scene, lights=(replace(light, **changes),))


def view_of(scene: Scene, revision: int = 1) -> ViewRequest:
    viewport = Viewport(1, 1, "lit", WHOLE, (SIZE, SIZE))
    return ViewRequest("", viewport, DrawingShape("ball"), IDENTITY, revision, scene)


def contributions(scene: Scene, drawing: PreparedDrawing) -> Sequence[LightContribution]:
    view = view_of(scene).resolve(drawing)
    assert view is not None
    return view.contributions


def direct(contribution: LightContribution, drawing: PreparedDrawing) -> np.ndarray:
    """The closed form, in the elements in which light is anticipated."""
    _, _, width, height = contribution.area
    size = tuple(round(side * LONGEST / max(width, height)) for side in (width, height))
    surface = SketchedSurface.of(drawing, contribution.area, (size[0], size[1]))
    light = contribution.light
    assert isinstance(light, AreaLight)
    return grey(surface.light(light, contribution.canvas))


def traced(contribution: LightContribution, first: np.ndarray) -> AccumulatedLight:
    return AccumulatedLight(CONVERGED, 8, contribution.amounts, first, np.zeros_like(first))


def test_a_moved_light_is_its_direct_light_and_what_bounced_before(
    drawing: PreparedDrawing,
) -> None:
    """The bounced light counts the less, the further the light has moved."""
    lights = LightStore()
    before = contributions(lit_from(40.0), drawing)[0]
    lights.put(before, traced(before, direct(before, drawing) + np.float32(BOUNCED)))
    bounced = []
    for x in (44.0, 80.0, 140.0):
        moved = contributions(lit_from(x), drawing)[0]
        found = Anticipation(lights).of(moved, drawing)
        assert found is not None
        beside = found.light.first - direct(moved, drawing)
        assert beside.std() < 1e-3
        bounced.append(float(beside.mean()))
    assert bounced[0] == pytest.approx(BOUNCED, rel=0.02)
    assert BOUNCED > bounced[1] > 2 * bounced[2]


def test_a_bright_edge_that_was_missed_does_not_shine_elsewhere(drawing: PreparedDrawing) -> None:
    lights = LightStore()
    before, moved = (contributions(lit_from(x), drawing)[0] for x in (40.0, 42.0))
    lights.put(before, traced(before, direct(before, drawing) + np.float32(3.0)))
    found = Anticipation(lights).of(moved, drawing)
    assert found is not None
    beside = found.light.first - direct(moved, drawing)
    assert beside.max() <= MOST_ADDED + 1e-5
    assert found.light.first.min() >= 0


def test_the_nearest_place_is_what_corrects(drawing: PreparedDrawing) -> None:
    lights = LightStore()
    for x in (20.0, 70.0, 140.0):
        at = contributions(lit_from(x), drawing)[0]
        lights.put(at, traced(at, direct(at, drawing)))
    found = Anticipation(lights).of(contributions(lit_from(77.0), drawing)[0], drawing)
    assert found is not None
    assert found.corrected_by == (contributions(lit_from(70.0), drawing)[0].key, CONVERGED)


@pytest.mark.parametrize("change", [{"kind": "sun"}, {"casts_shadow": False}])
def test_nothing_is_known_of_a_light_of_another_kind(
    drawing: PreparedDrawing, change: dict[str, object]
) -> None:
    lights = LightStore()
    before = contributions(lit_from(40.0), drawing)[0]
    lights.put(before, traced(before, direct(before, drawing)))
    other = contributions(lit_from(42.0, **change), drawing)[0]
    assert Anticipation(lights).of(other, drawing) is None


def test_a_light_without_shadow_is_sketched_without(drawing: PreparedDrawing) -> None:
    """From the side, the ball hides a low light from its far half."""
    surface = SketchedSurface.of(drawing, WHOLE, (64, 64))
    canvas = default_scene(SIZE, SIZE).canvas
    light = AreaLight(0.0, 80.0, 20.0, 10.0)
    shaded, bare = (
        surface.light(replace(light, casts_shadow=casts), canvas) for casts in (True, False)
    )
    assert (shaded <= bare).all()
    assert shaded.sum() < bare.sum()


def test_the_picture_of_a_moved_light_does_not_wait_for_the_renderer(
    drawing: PreparedDrawing,
) -> None:
    """No renderer runs here: only the first place of the light was traced."""
    state, painted = PreviewState(), list[PreviewImage]()
    painter = Painter(state, painted.append, lambda _, error: pytest.fail(str(error)))
    state.drawings.put((DrawingShape("ball"), "quick"), drawing, drawing.nbytes)
    for contribution in contributions(lit_from(40.0), drawing):
        state.lights.put(contribution, traced(contribution, direct_or_dim(contribution, drawing)))
    for revision, x in enumerate((40.0, 120.0), 1):
        view = view_of(lit_from(x), revision)
        state.show({"": view}, (), ())
        painter.offer(view)
        assert painter.step()
    first, moved = painted
    assert (first.spp, moved.spp) == (8, 0)
    assert not moved.converged
    left, right = np.s_[60:100, 40:60], np.s_[60:100, 100:120]
    assert first.picture[left].mean() > first.picture[right].mean() + 10
    assert moved.picture[right].mean() > moved.picture[left].mean() + 10


def direct_or_dim(contribution: LightContribution, drawing: PreparedDrawing) -> np.ndarray:
    if contribution.light is None:
        return np.full((8, 8, 3), 0.1, np.float32)
    return direct(contribution, drawing)
