"""The data set: reproducible and exact; other files are refused."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image
from scipy import ndimage
from shapes import sphere_model

from lampblack.errors import LampblackError, LampblackWarning
from lampblack_research.dataset.anatomy.implicit_surface import ImplicitSurface
from lampblack_research.dataset.anatomy.lathe import lathe
from lampblack_research.dataset.build import DatasetOptions, build_dataset, entries
from lampblack_research.dataset.creatures import creature
from lampblack_research.dataset.deform import deformed
from lampblack_research.dataset.freestyle import Stroke, draw_freestyle
from lampblack_research.dataset.gbuffer import place, trace, trace_placed, view_rotation
from lampblack_research.dataset.models import Model
from lampblack_research.dataset.smooth import smoothed
from lampblack_research.dataset.triple import BEHIND, IN_FRONT, Triple, occlusion_edges
from lampblack_research.dataset.viewpoints import viewpoint
from support.command_line import Run

OPTIONS = DatasetOptions(views=2, resolution=96, hands=2, freestyle=0)


@pytest.fixture
def models(tmp_path: Path) -> Path:
    folder = tmp_path / "models"
    folder.mkdir()
    trimesh.creation.icosphere(subdivisions=2).export(folder / "ball.ply")
    trimesh.creation.capsule(radius=0.4).export(folder / "pill.obj")
    return folder


@pytest.mark.parametrize("freestyle", [0, pytest.param(0.5, marks=pytest.mark.cycles)])
def test_a_data_set_is_the_same_however_often_it_is_interrupted(
    models: Path, tmp_path: Path, freestyle: float
) -> None:
    options = replace(OPTIONS, freestyle=freestyle)
    once, twice = tmp_path / "once", tmp_path / "twice"
    assert build_dataset(models, once, None, options) == 4
    build_dataset(models, twice, None, options)
    for removed in sorted(twice.rglob("*.npz"))[:3]:
        removed.unlink()
    assert build_dataset(models, twice, None, options) == 4
    for a, b in zip(sorted(once.rglob("*.npz")), sorted(twice.rglob("*.npz")), strict=True):
        first, second = Triple.load(a), Triple.load(b)
        assert np.array_equal(first.drawings, second.drawings)
        assert np.array_equal(first.normals, second.normals)


def test_a_bad_model_is_told_once_and_ends_nothing(models: Path, tmp_path: Path) -> None:
    (models / "broken.obj").write_text("junk")
    bad = np.eye(4, 3), np.array([[0, 1, 9]])
    np.savez(models / "index.npz", vertices=bad[0], faces=bad[1])
    with pytest.warns(LampblackWarning) as told:
        assert build_dataset(models, tmp_path / "data", None, OPTIONS) == 4
    assert [Path(str(w.message).split()[0]).name for w in told] == ["broken.obj", "index.npz"]


def test_random_creatures_are_the_same_every_time(models: Path, tmp_path: Path) -> None:
    options = replace(OPTIONS, creatures=3)
    assert build_dataset(models, tmp_path / "data", None, options) == 7
    assert len(list((tmp_path / "data" / "creatures").glob("*.npz"))) == 3
    first, again = (creature("a", np.random.default_rng(5)) for _ in range(2))
    assert np.array_equal(first.vertices, again.vertices)
    assert np.array_equal(first.corner_normals, again.corner_normals)
    low, high = first.vertices.min(axis=0), first.vertices.max(axis=0)
    assert np.abs(low + high).max() < 1e-5
    assert np.linalg.norm(high - low) == pytest.approx(2, abs=1e-4)


def test_creatures_need_no_models(tmp_path: Path) -> None:
    assert build_dataset(None, tmp_path, None, replace(OPTIONS, creatures=2)) == 2
    with pytest.raises(LampblackError, match="nothing to draw"):
        build_dataset(None, tmp_path, None, OPTIONS)


def test_random_creatures_have_the_normals_of_their_surface() -> None:
    for seed in range(8):
        model = creature("a", np.random.default_rng(seed))
        corners = model.vertices[model.faces]
        flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        alike = np.einsum("fc,fkc->fk", flat, model.corner_normals)
        assert (alike < 0).mean() < 0.01  # nothing is inside out
        assert np.abs(np.linalg.norm(model.corner_normals, axis=-1) - 1).max() < 1e-3
        view = trace(model, view_rotation(20, 10), 256)
        down, right = np.gradient(view.depth)
        slope = np.stack([-right, down, np.ones_like(down)], axis=-1)
        slope /= np.linalg.norm(slope, axis=-1, keepdims=True)
        broken = np.zeros_like(view.mask)
        for axis in (0, 1):
            around = [np.roll(view.depth, shift, axis) for shift in (1, -1)]
            broken |= np.abs(around[0] + around[1] - 2 * view.depth) > 1
        smooth = ~ndimage.binary_dilation(broken | ~view.mask, iterations=2)
        angle = np.degrees(np.arccos(np.clip((slope * view.normals).sum(axis=-1), -1, 1)))
        assert angle[smooth].mean() < 3
        assert np.median(angle[smooth]) < 1.5


def test_an_implicit_surface_is_as_exact_as_its_parts() -> None:
    surface = ImplicitSurface()
    surface.cone(np.array([-1.0, 0, 0]), 0.5, np.array([1.0, 0, 0]), 0.5, 0.0)
    mesh = surface.mesh(48)
    axis = np.clip(mesh.vertices[:, 0], -1, 1)[:, None] * [1.0, 0, 0]
    outward = (mesh.vertices - axis) / 0.5
    assert np.abs(np.linalg.norm(outward, axis=1) - 1).max() < 1e-4
    assert np.abs(outward - mesh.normals).max() < 0.01
    solid = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    assert solid.is_watertight
    assert solid.volume == pytest.approx(np.pi / 2 + np.pi / 6, rel=0.01)


def test_a_subtracted_ellipsoid_is_hollow() -> None:
    surface = ImplicitSurface()
    surface.ellipsoid(np.zeros(3), np.ones(3), 0.0)
    surface.dent(np.array([0, 0, 1.0]), np.full(3, 0.5), 0.05)
    mesh = surface.mesh(64)
    inside = np.linalg.norm(mesh.vertices - [0, 0, 1], axis=1) < 0.5 + 1e-3
    inside &= np.hypot(mesh.vertices[:, 0], mesh.vertices[:, 1]) < 0.35
    towards = (np.array([0, 0, 1]) - mesh.vertices[inside]) / 0.5
    assert inside.sum() > 50
    assert np.abs(towards - mesh.normals[inside]).max() < 0.02


def test_a_cylinder_of_the_lathe_has_a_wall() -> None:
    mesh = lathe(np.array([[1.0, 0.5], [1.0, -0.5]]), 0.1)
    solid = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    assert solid.is_watertight
    assert solid.volume == pytest.approx(2 * np.pi * (0.1 + np.pi * 0.05**2), rel=0.02)
    straight = np.abs(mesh.vertices[:, 1]) < 0.4
    radial = mesh.vertices[straight] * [1, 0, 1]
    outward = np.sign(np.linalg.norm(radial, axis=1) - 1)
    radial /= np.linalg.norm(radial, axis=1, keepdims=True)
    assert (np.einsum("vc,vc->v", radial, mesh.normals[straight]) * outward).min() > 0.999


def test_models_of_a_large_source_give_fewer_views() -> None:
    paths = [Path("many") / f"{n}.npz" for n in range(240)] + [Path("few/a.npz")]
    built = list(entries(paths, 8))
    assert sum(path.parent.name == "few" for path, _ in built) == 8
    assert len(built) == 8 + 2 * 240
    assert {index for _, index in built[: len(paths)]} == {0}


def test_triples_keep_their_truth(tmp_path: Path) -> None:
    view = trace(sphere_model(4), view_rotation(0, 0), 120)
    lines = np.random.default_rng(0).random(view.mask.shape).astype(np.float32)
    Triple.of(view, [lines], 4.0).save(tmp_path / "a.npz")
    kept = Triple.load(tmp_path / "a.npz")
    assert np.abs(kept.normals / 127 - view.normals).max() < 0.005
    assert np.abs(kept.depth / 16 - view.depth).max() <= 1 / 32
    assert np.array_equal(kept.mask, view.mask)
    assert np.abs(kept.drawings[0] / 255 - lines).max() < 0.003
    for content in (b"", b"PK\x03\x04"):
        (tmp_path / "a.npz").write_bytes(content)
        with pytest.raises(LampblackError):
            Triple.load(tmp_path / "a.npz")


def test_the_nearer_side_of_an_occlusion_is_in_front() -> None:
    """A small plate before a large one."""
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], np.float32)
    vertices = np.concatenate(
        [np.column_stack([s * corners, np.full(4, z)]) for s, z in ((1, 0), (0.5, 0.5))]
    ).astype(np.float32)
    faces = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]], np.int32)
    normals = np.tile(np.array([0, 0, 1], np.float32), (4, 3, 1))
    view = trace(Model("plates", vertices, faces, normals, False), view_rotation(0, 0), 100)
    edges = occlusion_edges(view, 10.0)
    near = view.depth > view.depth.max() - 1
    assert (edges[near] == IN_FRONT).sum() > 4 * 45
    assert not (edges[near] == BEHIND).any()
    assert (edges == BEHIND).sum() > 4 * 45
    assert edges[58, 58] == 0


def test_smoothing_rounds_a_coarse_ball() -> None:
    coarse = sphere_model(1)
    rounds = [
        np.linalg.norm(m.vertices[m.faces].mean(axis=1), axis=1) for m in (coarse, smoothed(coarse))
    ]
    assert rounds[1].min() > 0.97 > rounds[0].min()


def test_a_deformed_model_has_the_normals_of_its_surface() -> None:
    model = deformed(sphere_model(5), np.random.default_rng(3))
    corners = model.vertices[model.faces]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat /= np.linalg.norm(flat, axis=1, keepdims=True)
    alike = np.einsum("fc,fkc->fk", flat, model.corner_normals)
    assert np.degrees(np.arccos(alike.min())) < 8
    assert np.abs(np.linalg.norm(model.vertices, axis=1) - 1).max() > 0.05


def test_viewpoints_are_those_an_artist_draws() -> None:
    looks = np.stack([viewpoint(i, np.random.default_rng(i))[2] for i in range(42)])
    assert (looks[:, 2] > 0).sum() > 21  # mostly the front
    assert (looks[:, 1] < -0.3).sum() <= 4  # few from below
    assert np.ptp(np.arctan2(looks[:, 0], looks[:, 2])) > 4


def test_a_long_character_grows_to_the_area_of_a_square() -> None:
    pole = sphere_model()
    pole = Model("a/pole", pole.vertices * [0.5, 1, 0.5], pole.faces, pole.corner_normals, False)
    rows, columns = place(pole, view_rotation(0, 0), 100, equal_area=True).size
    assert (rows - 16) * (columns - 16) == pytest.approx(100 * 100, rel=0.05)
    assert trace_placed(place(pole, view_rotation(0, 0), 100)).mask.shape == (116, 66)


@pytest.mark.cycles
def test_freestyle_draws_the_silhouette_where_it_is() -> None:
    placed = place(sphere_model(4), view_rotation(20, 10), 150)
    (ink,) = draw_freestyle([(placed, Stroke(width=4.0, taper=False))])
    assert ink is not None
    mask = trace_placed(placed).mask
    rim = mask & (ndimage.distance_transform_edt(mask) < 2)
    assert ink[rim].mean() > 0.6
    assert ink[mask & (ndimage.distance_transform_edt(mask) > 5)].max() < 0.1


@pytest.mark.cycles
def test_a_freestyle_drawing_is_the_same_whatever_is_drawn_before_it() -> None:
    placed = place(sphere_model(3), view_rotation(20, 10), 120)
    trembling = placed, Stroke(width=3.0, wobble=2.0, seed=7)
    (alone,) = draw_freestyle([trembling])
    _, later = draw_freestyle([(placed, Stroke(width=5.0, wobble=1.0, seed=1)), trembling])
    (other,) = draw_freestyle([(placed, Stroke(width=3.0, wobble=2.0, seed=8))])
    assert alone is not None
    assert np.array_equal(alone, later)
    assert not np.array_equal(alone, other)


def test_the_command_builds_a_described_data_set(models: Path, tmp_path: Path, run: Run) -> None:
    folder = tmp_path / "data"
    command = ("dataset", "build", "--models", models, "-o", folder, "--views", 1)
    command += ("--resolution", 96, "--freestyle", 0, "--workers", 1)
    for _ in range(2):
        done = run(*command)
        assert done.code == 0
        assert "2 entries" in done.err + done.out
    card = json.loads((folder / "card.json").read_text())
    assert sum(card["entries"].values()) == 2
    with Image.open(folder / "sheet.png") as sheet:
        assert sheet.width > sheet.height
    (tmp_path / "empty").mkdir()
    failed = run("dataset", "build", "--models", tmp_path / "empty", "-o", folder)
    assert failed.code != 0
    assert "holds no models" in failed.err
