"""The nearest face at every pixel, where it is known."""

from __future__ import annotations

import numpy as np

from lampblack.surface import visible_faces

SQUARE = np.array([[0, 1, 2], [0, 2, 3]])


def test_faces_that_share_an_edge_leave_no_gap() -> None:
    """A plane of jittered triangles, many of whose edges pass through centres of pixels."""
    rng = np.random.default_rng(0)
    y, x = np.mgrid[0:13, 0:13] * 5.0
    inner = (x > 0) & (x < 60) & (y > 0) & (y < 60)
    x, y = (np.round(n + inner * rng.uniform(-2, 2, n.shape), 1) for n in (x, y))
    vertices = np.stack([x, y, 2 * x - y], axis=-1).reshape(-1, 3).astype(np.float32)
    corner = np.arange(169).reshape(13, 13)[:-1, :-1].reshape(-1, 1)
    faces = np.concatenate([np.add(corner, [0, 1, 14]), np.add(corner, [14, 13, 0])])
    found = visible_faces(vertices, faces, (60, 60))
    assert (found.face >= 0).all()
    u, v = found.u[..., None], found.v[..., None]
    a, b, c = vertices[faces[found.face]].transpose(2, 0, 1, 3)
    rows, columns = np.mgrid[0:60, 0:60] + 0.5
    points = np.stack([columns, rows, 2 * columns - rows], axis=-1)
    assert np.allclose((1 - u - v) * a + u * b + v * c, points, atol=1e-4)


def test_the_nearer_face_is_seen_from_either_side() -> None:
    far = np.array([[0, 0, 0], [8, 0, 0], [8, 8, 0], [0, 8, 0]], np.float32)
    near = far / 2 + np.array([0, 0, 1], np.float32)
    faces = np.concatenate([SQUARE, 4 + SQUARE[:, ::-1]])
    for order in (faces, faces[::-1]):
        face = visible_faces(np.concatenate([far, near]), order, (9, 9)).face
        seen = np.where(face < 0, -1, order[face].min(axis=-1) // 4)
        assert (seen[:4, :4] == 1).all()
        assert (seen[4:8, :8] == 0).all()
        assert (seen[8] == -1).all()


def test_what_lies_outside_or_has_no_area_is_not_seen() -> None:
    vertices = np.array([[-9, -9, 0], [20, -9, 0], [5, 40, 0], [-9, -9, 5]], np.float32)
    found = visible_faces(vertices, np.array([[0, 1, 3], [0, 1, 2]]), (4, 6))
    assert (found.face == 1).all()
    assert (visible_faces(vertices + 100, np.array([[0, 1, 2]]), (4, 6)).face == -1).all()
