"""A drawing on several layers, prepared: surfaces, paint and steadiness of its bodies."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray

from lampblack.cache import ArrayCache
from lampblack.colour import linear
from lampblack.drawing import DrawingPlanes, decompose_cel, decompose_drawing
from lampblack.finals.neighbours import NeighbourLoader
from lampblack.finals.resolve import resolve_shot
from lampblack.finals.scene_file import save_scene
from lampblack.finals.settings import RenderSettings
from lampblack.pipeline import Pipeline
from lampblack.prepared import PreparedDrawing
from lampblack.scene import LayerBody, Material, default_scene
from lampblack.surface import check_relief, visible_faces
from support.command_line import Run
from support.drawings import draw_capsule, layered_cel
from support.projects import document, image, layer, png, write_project

Picture = NDArray[np.uint8]
SIZE = 200, 160
BODY = draw_capsule(SIZE, (90, 84), (90, 84), 60, (200, 110, 60))
ARM = draw_capsule(SIZE, (50, 80), (176, 74), 13)


@pytest.fixture(scope="module")
def pipeline(tmp_path_factory: pytest.TempPathFactory) -> Pipeline:
    return Pipeline(ArrayCache(tmp_path_factory.mktemp("cache")))


@pytest.fixture(scope="module")
def prepared(pipeline: Pipeline) -> PreparedDrawing:
    cel = layered_cel(body=BODY, arm=ARM)
    return pipeline.prepare(decompose_cel(cel), with_normals=True)


def test_each_body_has_its_own_surface_in_the_order_of_the_layers(
    prepared: PreparedDrawing,
) -> None:
    relief = prepared.relief()
    assert check_relief(relief) == []
    assert relief.bodies is not None
    hit = visible_faces(relief.vertices, relief.faces, SIZE[::-1])
    seen = np.where(hit.face >= 0, relief.bodies[relief.faces[hit.face, 0]], -1)
    assert (seen[ARM[..., 3] >= 128] == 1).all()
    assert (seen[(BODY[..., 3] >= 128) & (ARM[..., 3] < 128)] == 0).all()


def test_what_is_covered_is_as_if_nothing_covered_it(
    pipeline: Pipeline, prepared: PreparedDrawing
) -> None:
    alone = pipeline.prepare(decompose_drawing(BODY)).height
    body = prepared.bodies[0]
    rows, columns = body.drawing.height.shape
    place = slice(body.top, body.top + rows), slice(body.left, body.left + columns)
    assert np.abs(body.drawing.height - alone[place]).max() < 0.02 * alone.max()
    visible = prepared.mask & (ARM[..., 3] == 0)
    assert np.abs(prepared.height - alone)[visible].max() < 0.02 * alone.max()
    assert prepared.height[80, 90] > alone[80, 90] + 5


def test_height_and_normals_of_the_whole_are_those_that_are_seen(
    prepared: PreparedDrawing,
) -> None:
    relief = prepared.relief()
    hit = visible_faces(relief.vertices, relief.faces, SIZE[::-1])
    rows, columns = np.nonzero(prepared.mask & (hit.face >= 0))
    corners = relief.vertices[relief.faces[hit.face[rows, columns]], 2]
    u, v = hit.u[rows, columns], hit.v[rows, columns]
    level = (1 - u - v) * corners[:, 0] + u * corners[:, 1] + v * corners[:, 2]
    assert np.median(np.abs(level - prepared.height[rows, columns])) < 0.2
    assert prepared.normals is not None
    length = np.linalg.norm(prepared.normals.astype(np.float32), axis=2)
    assert np.allclose(length[prepared.mask], 1, atol=1e-3)
    assert not length[~prepared.mask].any()


def test_covered_paint_keeps_its_colour_and_material(prepared: PreparedDrawing) -> None:
    scene = default_scene(*SIZE)
    glossy = Material(glossy=True, gloss=0.7, roughness=0.1)
    scene.materials["#c86e3c"] = glossy
    for drawing in (prepared, prepared.compact()):
        surface = drawing.surface(scene, 2)
        relief = surface.relief
        assert relief.bodies is not None
        own = linear(np.array([[200, 110, 60], [225, 170, 120]]) / 255)
        for index, amount in enumerate((0.7, 0.0)):
            front = relief.vertices[: relief.front]
            inner = np.hypot(front[:, 0] - 90, front[:, 1] - 78) < 12  # under the arm
            inner &= relief.bodies[: len(front)] == index
            assert inner.any()
            vertices = np.flatnonzero(inner)
            assert np.abs(surface.albedo[vertices] - own[index]).max() < 0.02
            assert np.allclose(surface.gloss[vertices], amount)


def test_quick_detail_has_the_same_bodies(pipeline: Pipeline, prepared: PreparedDrawing) -> None:
    large = [np.kron(p, np.ones((4, 4, 1), np.uint8)) for p in (BODY, ARM)]
    cel = layered_cel(body=large[0], arm=large[1])
    quick = pipeline.prepare_quick(DrawingPlanes(cel.pixels, layers=cel.layers), "digest")
    assert [body.name for body in quick.bodies] == ["body", "arm"]
    assert (quick.digest, quick.detail, quick.size) == ("digest", "quick", (800, 640))
    relief = quick.relief()
    assert check_relief(relief) == []
    # In pixels of the drawing, like the full one, four times as large.
    low, high = relief.vertices.min(axis=0), relief.vertices.max(axis=0)
    full = prepared.relief().vertices * 4
    assert np.allclose(low[:2], full.min(axis=0)[:2], atol=8)
    assert np.allclose(high[:2], full.max(axis=0)[:2], atol=8)
    assert high[2] == pytest.approx(full[:, 2].max(), rel=0.25)
    assert quick.normals is not None
    assert quick.normals.shape[:2] == quick.mask.shape == quick.height.shape


def project(folder: Path, moves: list[tuple[int, int]]) -> RenderSettings:
    """A body that is the same in every frame, and an arm that moves as a whole."""
    keys = [image(n, "arm.png", -100 + x, -80 + y) for n, (x, y) in enumerate(moves, start=1)]
    layers = [layer(2, "body", [image(1, "body.png", -100, -80)]), layer(3, "arm", keys)]
    files = {"body.png": png(BODY), "arm.png": png(ARM)}
    path = write_project(folder / "wave.pclx", document(layers, size=SIZE), files)
    return RenderSettings(inputs=(str(path),), output=str(folder / "lit"))


def test_a_body_that_moves_as_a_whole_keeps_its_surface(tmp_path: Path) -> None:
    shot = resolve_shot(project(tmp_path, [(0, 0), (-4, -9), (3, 8), (-8, 2)]))
    made: list[str] = []

    class Counting(ArrayCache):
        def get(self, key, make):  # type: ignore[no-untyped-def]
            return super().get(key, lambda: (made.append(key), make())[1])

    pipeline = Pipeline(Counting(tmp_path / "cache"))
    loader = NeighbourLoader(shot.shot, pipeline)
    heights, first = [], 0
    for frame in shot.frames:
        drawing = loader.drawing(frame)
        assert [body.name for body in drawing.bodies] == ["body", "arm"]
        pipeline.prepare(drawing, loader.neighbours(frame))
        heights.append([pipeline.prepare(body.drawing).height for body in drawing.bodies])
        first = first or len(made)
    assert len(made) == first > 0  # each body was made once
    for later in heights[1:]:
        for one, other in zip(heights[0], later, strict=True):
            assert np.array_equal(one, other)


def test_bodies_are_steadied_by_the_bodies_of_their_layer(tmp_path: Path) -> None:
    settings = project(tmp_path, [(0, 0), (0, 0)])
    longer = draw_capsule(SIZE, (50, 80), (180, 84), 14)
    keys = [image(1, "arm.png", -100, -80), image(2, "longer.png", -100, -80)]
    layers = [layer(2, "body", [image(1, "body.png", -100, -80)]), layer(3, "arm", keys)]
    files = {"body.png": png(BODY), "arm.png": png(ARM), "longer.png": png(longer)}
    write_project(Path(settings.inputs[0]), document(layers, size=SIZE), files)
    shot = resolve_shot(settings)
    pipeline = Pipeline(ArrayCache(tmp_path / "cache"))
    loader = NeighbourLoader(shot.shot, pipeline)
    drawing, around = loader.drawing(shot.frames[0]), loader.neighbours(shot.frames[0])
    assert around is not None
    assert around.of_body("body") is None
    assert around.of_body("nobody") is None
    arm = around.of_body("arm")
    assert arm is not None
    assert [len(side) for side in arm.keys] == [0, 1]
    steady = pipeline.prepare(drawing, around).bodies[1].drawing.height
    alone = pipeline.prepare(drawing).bodies[1].drawing.height
    assert 0 < np.abs(steady - alone).mean() < 0.05 * alone.max()


def test_exported_bodies_are_meshes_in_their_own_colours(
    pipeline: Pipeline, tmp_path: Path
) -> None:
    drawing = decompose_cel(layered_cel(body=BODY, arm=ARM))
    prepared = pipeline.prepare(drawing)
    save_scene(drawing, prepared, default_scene(*SIZE), tmp_path / "both.glb")
    scene = trimesh.load(io.BytesIO((tmp_path / "both.glb").read_bytes()), "glb")
    assert len(scene.geometry) == 2
    for mesh, colour in zip(
        scene.geometry.values(), ([200, 110, 60], [225, 170, 120]), strict=True
    ):
        picture = np.asarray(mesh.visual.material.baseColorTexture.convert("RGB"))
        x, y = 2 * (85 / SIZE[0] - 0.5), SIZE[1] / SIZE[0] * (1 - 2 * 78 / SIZE[1])
        near = np.hypot(mesh.vertices[:, 0] - x, mesh.vertices[:, 1] - y).argmin()
        u, v = mesh.visual.uv[near]
        row, column = int((1 - v) * picture.shape[0]), int(u * picture.shape[1])
        assert np.abs(picture[row, column].astype(int) - colour).max() <= 1


def test_layers_of_a_project_on_the_command_line(run: Run, tmp_path: Path) -> None:
    (path,) = project(tmp_path, [(0, 0)]).inputs
    assert run("height", path, "-o", tmp_path / "own.npy").code == 0
    told = run("height", path, "-o", tmp_path / "below.npy", "--layer-body", "arm=below")
    assert told.code == 0
    own, below = (np.load(tmp_path / f"{name}.npy") for name in ("own", "below"))
    assert np.array_equal(np.isfinite(own), np.isfinite(below))
    arm = ARM[..., 3] == 255
    assert (own - below)[arm].mean() > 5
    for wrong in ("arm", "arm=above", "=own"):
        refused = run("height", path, "-o", tmp_path / "no.npy", "--layer-body", wrong)
        assert refused.code == 1
        assert "LAYER=BODY" in refused.err


def test_what_is_painted_on_leaves_the_surface_below_as_it_is(pipeline: Pipeline) -> None:
    """Where it sticks out, it goes on at the height of what is nearest."""
    cel = layered_cel(body=BODY, arm=ARM)
    drawing = decompose_cel(cel, [LayerBody("arm", "flat")])
    assert [body.name for body in drawing.bodies] == ["body"]
    prepared = pipeline.prepare(drawing)
    alone = pipeline.prepare(decompose_drawing(BODY)).height
    inside = (BODY[..., 3] >= 128) & drawing.mask
    rows, columns = np.nonzero(inside & (alone > 0))
    assert np.abs(prepared.height - alone)[rows, columns].max() < 1e-3
    sticks_out = drawing.mask & ~inside
    assert np.count_nonzero(sticks_out) > 100
    assert prepared.height[sticks_out].max() <= alone.max()
    assert check_relief(prepared.relief()) == []
