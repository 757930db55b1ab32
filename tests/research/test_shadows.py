"""Shadows between parts, on scenes whose shadows are known."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from lampblack.surface import build_relief
from lampblack_research.dataset.gbuffer import place, trace_placed, view_rotation
from lampblack_research.dataset.models import Model
from lampblack_research.evaluation.shadows import (
    LIGHTS,
    ShadowTruth,
    light_direction,
)
from lampblack_research.evaluation.surfaces import surface_of_height


def model_of(mesh: trimesh.Trimesh) -> Model:
    """A model with the flat normals of its faces."""
    vertices, faces = mesh.vertices.astype(np.float32), mesh.faces.astype(np.int32)
    normals = np.repeat(mesh.face_normals.astype(np.float32)[:, None], 3, axis=1)
    return Model("a/scene", vertices, faces, normals, False)


def truth_of(mesh: trimesh.Trimesh) -> tuple[ShadowTruth, np.ndarray, np.ndarray]:
    placed = place(model_of(mesh), view_rotation(0, 0), 200)
    view = trace_placed(placed)
    truth = ShadowTruth(placed.vertices, placed.faces, view.normals, view.mask, 200)
    return truth, view.depth, view.mask


def wall_with_post() -> trimesh.Trimesh:
    wall = trimesh.creation.box(extents=(2, 2, 0.1))
    post = trimesh.creation.box(extents=(0.2, 1, 0.4))
    post.apply_translation((0, 0, 0.25))
    return trimesh.util.concatenate([wall, post])


def wall_with_bar() -> trimesh.Trimesh:
    """A thin bar before a wall, which light passes beneath."""
    wall = trimesh.creation.box(extents=(2, 2, 0.1))
    bar = trimesh.creation.box(extents=(0.2, 1, 0.02))
    bar.apply_translation((0, 0, 0.44))
    return trimesh.util.concatenate([wall, bar])


def test_the_relief_of_the_true_depth_has_the_true_shadows() -> None:
    truth, depth, mask = truth_of(wall_with_bar())
    relief = surface_of_height(depth, mask).relief
    found = truth.measure(relief.vertices, relief.faces)
    assert found.shadow_recall > 0.9
    assert found.shadow_precision > 0.97


def test_a_flat_relief_has_no_shadows_and_a_higher_one_other_shadows() -> None:
    truth, depth, mask = truth_of(wall_with_bar())
    flat = build_relief(np.zeros_like(depth), mask)
    found = truth.measure(flat.vertices, flat.faces)
    assert found.shadow_recall == 0
    assert np.isnan(found.shadow_precision)
    high = build_relief(np.where(mask, 2 * depth, 0), mask)
    found = truth.measure(high.vertices, high.faces)
    assert found.shadow_recall < 0.2
    assert found.shadow_precision < 0.2


def test_the_shadow_of_a_post_has_its_length() -> None:
    truth, _, mask = truth_of(wall_with_post())
    pixels = 100.0  # a unit of the scene
    for index, (azimuth, elevation) in enumerate(LIGHTS):
        if azimuth not in (0.0, 180.0):
            continue
        shadow = np.count_nonzero(truth._shadowed[index] & truth._counted[index]) * 4
        length = min(0.4 * pixels / np.tan(np.radians(elevation)), 0.9 * pixels)
        assert shadow == pytest.approx(length * pixels, rel=0.05)
    assert mask.any()


def test_the_shaded_side_of_a_ball_is_no_shadow_between_parts() -> None:
    ball = trimesh.creation.icosphere(subdivisions=5)
    smooth = replace(model_of(ball), corner_normals=ball.vertices.astype(np.float32)[ball.faces])
    placed = place(smooth, view_rotation(0, 0), 200)
    view = trace_placed(placed)
    truth = ShadowTruth(placed.vertices, placed.faces, view.normals, view.mask, 200)
    relief = surface_of_height(view.depth, view.mask).relief
    found = truth.measure(relief.vertices, relief.faces)
    assert np.isnan(found.shadow_recall)
    assert np.isnan(found.shadow_precision)


def test_lights_come_from_where_they_say() -> None:
    assert light_direction(90, 30) == pytest.approx([0, np.sqrt(0.75), 0.5], abs=1e-6)
    assert all(20 <= elevation <= 60 for _, elevation in LIGHTS)
