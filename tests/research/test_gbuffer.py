"""Ray casting against closed forms, and its lines."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from shapes import angles, ball, sphere_model

from lampblack.errors import LampblackError
from lampblack.surface import visible_faces
from lampblack_research.dataset.gbuffer import MARGIN, place, trace, view_rotation
from lampblack_research.dataset.linework import LineStyle, draw_lines


def test_trace_of_a_sphere_is_exact() -> None:
    view = trace(sphere_model(4), view_rotation(30, 20), 200)
    size = 200 + 2 * MARGIN
    mask, truth = ball(size, 100.0)
    assert view.mask.shape == (size, size)
    assert (view.mask != mask).mean() < 0.005
    both = view.mask & mask & (truth[..., 2] > 0.15)
    assert angles(view.normals, truth)[both].max() < 1.0
    depth = view.depth - view.depth.max()
    assert np.abs(depth - 100 * (truth[..., 2] - 1))[both].max() < 0.6


def test_views_turn_the_way_the_angles_say() -> None:
    nose = np.array([0.0, 0.0, 1.0])
    assert np.allclose(view_rotation(0, 0) @ nose, nose)
    assert np.allclose(view_rotation(90, 0) @ nose, [-1, 0, 0], atol=1e-6)
    assert (view_rotation(0, 30) @ nose)[1] < 0  # seen from above, the nose sinks


def test_line_follows_the_silhouette_of_a_sphere_only() -> None:
    view = trace(sphere_model(4), view_rotation(0, 0), 200)
    lines = draw_lines(view, LineStyle(width=3), np.random.default_rng(0))
    rim = view.mask & (view.normals[..., 2] < 0.3)
    assert lines[~view.mask].max() == 0
    assert lines[rim].mean() > 0.3
    assert lines[view.mask & (view.normals[..., 2] > 0.5)].max() == 0


def test_rasterised_faces_are_those_that_rays_hit() -> None:
    """Two ways to see a mesh, one of them Embree's."""
    placed = place(sphere_model(4), view_rotation(30, 20), 200)
    view = trace(sphere_model(4), view_rotation(30, 20), 200)
    vertices = placed.vertices.copy()
    vertices[:, 1] = placed.size[0] - vertices[:, 1]
    found = visible_faces(vertices, placed.faces, placed.size)
    assert np.array_equal(found.face >= 0, view.mask)
    z = vertices[placed.faces[found.face], 2]
    depth = (1 - found.u - found.v) * z[..., 0] + found.u * z[..., 1] + found.v * z[..., 2]
    assert depth[view.mask] == pytest.approx(view.depth[view.mask], abs=1e-3)


def test_without_the_ray_tracer_the_remedy_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "embreex.mesh_construction", None)
    with pytest.raises(LampblackError, match=r"lampblack\[research\]"):
        trace(sphere_model(), view_rotation(0, 0), 96)
