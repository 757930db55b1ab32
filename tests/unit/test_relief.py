"""The relief mesh: closed, in register with the drawing, cut at steps, and safe to save."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from scipy import ndimage

from lampblack.errors import LampblackError
from lampblack.surface.export import save_mesh
from lampblack.surface.relief import Relief, build_relief, check_relief
from lampblack.surface.visible import visible_faces

Heights = NDArray[np.float32]
Mask = NDArray[np.bool_]
SUB = 8


def blob(rows: int = 90, columns: int = 120) -> tuple[Heights, Mask]:
    """A dome with a hole, a thin whisker and a part of its own."""
    row, column = np.indices((rows, columns))
    reach = np.hypot((column - 50) / 45, (row - 42) / 38)
    mask = reach < 1
    mask &= np.hypot(column - 62, row - 30) > 8
    mask[60:62, 90:118] = True
    mask[5:14, 100:115] = True
    height = 40 * np.sqrt(np.maximum(1 - reach**2, 0)) - 5
    return (height * mask).astype(np.float32), mask


def is_sound(relief: Relief) -> bool:
    assert check_relief(relief) == []
    mesh = trimesh.Trimesh(relief.vertices * [1, -1, 1], relief.faces, process=False)
    return bool(mesh.is_watertight and mesh.is_winding_consistent and mesh.volume > 0)


def silhouette(relief: Relief, shape: tuple[int, ...]) -> Mask:
    """The mesh seen straight on, ``SUB`` samples a pixel each way."""
    image = Image.new("1", (shape[1] * SUB, shape[0] * SUB))
    draw = ImageDraw.Draw(image)
    front = relief.faces[(relief.faces < len(relief.vertices) // 2).all(axis=1)]
    for corners in relief.vertices[front][:, :, :2] * SUB - 0.5:
        draw.polygon([(float(x), float(y)) for x, y in corners], fill=1)
    return np.asarray(image)


def stray(relief: Relief, mask: Mask) -> tuple[float, float]:
    """Pixels by which the silhouette reaches out of the mask's outline, and falls short."""
    seen = np.pad(silhouette(relief, mask.shape), SUB)
    true = np.pad(np.kron(mask, np.ones((SUB, SUB), bool)), SUB)
    out = ndimage.distance_transform_edt(~true)[seen & ~true]
    short = ndimage.distance_transform_edt(true)[true & ~seen]
    return float(out.max(initial=0)) / SUB, float(short.max(initial=0)) / SUB


def test_silhouette_within_half_a_pixel_of_the_mask() -> None:
    height, mask = blob()
    out, short = stray(build_relief(height, mask), mask)
    assert out <= 0.5
    assert short <= 0.5


@pytest.mark.parametrize("stride", [2, 4])
def test_coarse_silhouette_follows_the_mask(stride: int) -> None:
    height, mask = blob()
    out, short = stray(build_relief(height, mask, stride=stride), mask)
    assert out <= 0.6 * stride
    assert short <= 0.6 * stride


@pytest.mark.parametrize("stride", [1, 2, 3, 4, 7])
def test_closed_with_holes_parts_and_whiskers(stride: int) -> None:
    height, mask = blob()
    assert is_sound(build_relief(height, mask, stride=stride))
    assert is_sound(build_relief(-height, mask, stride=stride, relief_scale=3))


def test_closed_for_any_mask_and_height() -> None:
    rng = np.random.default_rng(7)
    for _ in range(60):
        rows, columns, stride = (int(n) for n in rng.integers(1, (12, 12, 5)))
        mask = rng.random((rows, columns)) < rng.uniform(0.2, 1)
        mask[0, 0] = True
        height = rng.normal(scale=rng.choice([0.1, 50]), size=mask.shape).astype(np.float32)
        assert check_relief(build_relief(height, mask, stride=stride)) == []


def test_vertices_lie_on_the_pixels_they_sample() -> None:
    height, mask = blob()
    relief = build_relief(height, mask, relief_scale=0.5)
    nodes = relief.vertices[: np.count_nonzero(mask)]
    row, column = np.nonzero(mask)
    np.testing.assert_array_equal(nodes[:, 0], column + 0.5)
    np.testing.assert_array_equal(nodes[:, 1], row + 0.5)
    np.testing.assert_allclose(nodes[:, 2], 0.5 * height[mask])
    assert relief.vertices.dtype == np.float32
    assert relief.faces.dtype == np.int32


@pytest.mark.parametrize("stride", [1, 3])
def test_front_faces_the_viewer_and_hides_the_back(stride: int) -> None:
    height, mask = blob()
    relief = build_relief(height, mask, stride=stride)
    half = len(relief.vertices) // 2
    corners = (relief.vertices * np.array([1, -1, 1], np.float32))[relief.faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    front = (relief.faces < half).all(axis=1)
    back = (relief.faces >= half).all(axis=1)
    assert (normal[front, 2] > 0).all()
    assert (normal[back, 2] < 0).all()
    np.testing.assert_array_equal(relief.vertices[:half, :2], relief.vertices[half:, :2])
    assert (relief.vertices[:half, 2] - relief.vertices[half:, 2] >= 0.999).all()


@pytest.mark.parametrize("stride", [1, 2, 4])
def test_no_face_bridges_a_step(stride: int) -> None:
    row, column = np.indices((80, 80))
    disc = np.hypot(row - 40, column - 38) < 22
    mask = np.ones((80, 80), bool)
    height = (0.2 * column + 60 * disc).astype(np.float32)
    relief = build_relief(height, mask, stride=stride)
    assert is_sound(relief)
    front = relief.faces[(relief.faces < len(relief.vertices) // 2).all(axis=1)]
    levels = relief.vertices[front][:, :, 2]
    across = np.ptp(levels, axis=1) > 30
    # Only where a step one link long fades out may lips meet, and there the faces are slivers.
    corners = relief.vertices[front[across]][:, :, :2]
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    assert (np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) < 0.1).all()
    out, short = stray(relief, mask)
    assert out == 0
    assert short <= 0.5 * stride


def test_a_steep_dome_is_not_a_step() -> None:
    row, column = np.indices((200, 200))
    reach = np.hypot(row - 99.5, column - 99.5)
    mask = reach < 95
    height = np.sqrt(np.maximum(95**2 - reach**2, 0)).astype(np.float32)
    relief = build_relief(height, mask)
    rims = len(relief.vertices) // 2 - np.count_nonzero(mask)
    outline = sum(
        np.count_nonzero(np.diff(np.pad(mask, 1).astype(int), axis=axis)) for axis in (0, 1)
    )
    assert rims == outline


def test_check_tells_what_is_wrong() -> None:
    height, mask = blob(40, 40)
    sound = build_relief(height, mask, stride=2)
    assert "not closed" in check_relief(Relief(sound.vertices, sound.faces[1:]))[0]
    bad = sound.vertices.copy()
    bad[3] = np.nan
    assert any("finite" in text for text in check_relief(Relief(bad, sound.faces)))
    assert "no faces" in check_relief(Relief(sound.vertices, sound.faces[:0]))[0]
    flipped = np.concatenate([sound.faces[:1, ::-1], sound.faces[1:]])
    assert "wound" in check_relief(Relief(sound.vertices, flipped))[0]
    assert "exist" in check_relief(Relief(sound.vertices[:5], sound.faces))[0]
    flat = sound.vertices * np.float32(0)
    assert "degenerate" in check_relief(Relief(flat, sound.faces))[0]


def test_wrong_input_is_refused() -> None:
    height, mask = blob()
    with pytest.raises(ValueError, match="same"):
        build_relief(height, mask[1:])
    with pytest.raises(ValueError, match="stride"):
        build_relief(height, mask, stride=0)
    with pytest.raises(ValueError, match="finite"):
        build_relief(np.full_like(height, np.nan), mask)
    assert len(build_relief(height, np.zeros_like(mask)).faces) == 0


@pytest.mark.parametrize("suffix", [".glb", ".obj", ".ply", ".PLY"])
def test_export_round_trip(tmp_path: Path, suffix: str) -> None:
    height, mask = blob(50, 60)
    relief = build_relief(height, mask, stride=3)
    path = tmp_path / f"figure{suffix}"
    save_mesh(relief, path)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]
    mesh = trimesh.load_mesh(path, process=False)
    assert mesh.faces.shape == relief.faces.shape
    np.testing.assert_allclose(
        mesh.bounds[:, 1], [-relief.vertices[:, 1].max(), -relief.vertices[:, 1].min()], atol=1e-3
    )
    assert mesh.is_watertight
    assert mesh.volume > 0


def test_export_fails_with_advice_and_leaves_nothing(tmp_path: Path) -> None:
    relief = build_relief(*blob(40, 40), stride=3)
    with pytest.raises(LampblackError, match=r"\.glb"):
        save_mesh(relief, tmp_path / "figure.step")
    with pytest.raises(LampblackError, match="folder"):
        save_mesh(relief, tmp_path / "nowhere" / "figure.ply")
    (tmp_path / "taken.ply").mkdir()
    with pytest.raises(LampblackError, match="could not be written"):
        save_mesh(relief, tmp_path / "taken.ply")
    with pytest.raises(LampblackError, match="has errors"):
        save_mesh(Relief(relief.vertices, relief.faces[2:]), tmp_path / "torn.ply")
    assert [p.name for p in tmp_path.iterdir()] == ["taken.ply"]


def band_over_plate(size: int = 120) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """A bar across a plate, 40 pixels above it; both end at the canvas's margin."""
    height = np.zeros((size, size), np.float32)
    mask = np.zeros((size, size), bool)
    mask[10:-10, 10:-10] = True
    height[10:-10, 10:-10] = 20
    height[50:70, 10:-10] = 60
    return height, mask


@pytest.mark.parametrize("stride", [1, 2, 4])
def test_light_passes_beneath_what_is_in_front(stride: int) -> None:
    height, mask = band_over_plate()
    relief = build_relief(height, mask, stride=stride)
    assert check_relief(relief) == []
    half = len(relief.vertices) // 2
    front, back = relief.vertices[:half], relief.vertices[half:]
    bar = front[:, 2] == 60
    assert bar.any()
    assert (back[bar, 2] > 50).all()
    # The plate goes on under all of the bar.
    hidden = (front[:, 2] < 20) & (np.abs(front[:, 1] - 60) < 9)
    assert np.ptp(front[hidden, 0]) > 85
    assert (front[hidden, 2] > 20 - stride).all()


@pytest.mark.parametrize("stride", [1, 2, 4])
@pytest.mark.parametrize("coarse", [False, True])
def test_nothing_hidden_shows(stride: int, coarse: bool) -> None:
    height, mask = band_over_plate()
    rows, columns = np.mgrid[0:120, 0:120].astype(np.float32)
    height += np.where(mask, 12 * np.sin(columns / 19) + 9 * np.cos(rows / 23), 0)
    parts = np.zeros(mask.shape, int) if coarse else None
    relief = build_relief(height, mask, stride=stride, parts=parts)
    assert check_relief(relief) == []
    seen = visible_faces(relief.vertices, relief.faces, (120, 120))
    inside = mask & (seen.face >= 0)
    corners = relief.vertices[relief.faces[seen.face[inside]], 2]
    u, v = seen.u[inside], seen.v[inside]
    level = (1 - u - v) * corners[:, 0] + u * corners[:, 1] + v * corners[:, 2]
    away = np.abs(rows[inside] - 59.5)
    clear = np.abs(away - 10) > 2 * stride
    assert np.abs(level - height[inside])[clear].max() < 0.15 * stride


@pytest.mark.parametrize("stride", [1, 3])
def test_a_coarse_mesh_is_the_same_surface_with_fewer_triangles(stride: int) -> None:
    row, column = np.indices((200, 240))
    reach = np.hypot((column - 110) / 100, (row - 95) / 90)
    mask = (reach < 1) & (np.hypot(column - 140, row - 70) > 15)
    mask[100:104, 200:238] = True
    height = (90 * np.sqrt(np.maximum(1 - 0.9 * reach**2, 0)) * mask).astype(np.float32)
    fine = build_relief(height, mask, stride=stride)
    coarse = build_relief(height, mask, stride=stride, parts=np.zeros(mask.shape, int))
    assert is_sound(coarse)
    assert len(coarse.faces) < (0.5 if stride == 1 else 0.8) * len(fine.faces)
    surfaces = [
        visible_faces(relief.vertices, relief.faces, mask.shape) for relief in (fine, coarse)
    ]
    assert np.array_equal(surfaces[0].face >= 0, surfaces[1].face >= 0)
    levels = []
    for relief, seen in zip((fine, coarse), surfaces, strict=True):
        a, b, c = np.moveaxis(relief.vertices[relief.faces[seen.face], 2], 2, 0)
        levels.append(a + seen.u * (b - a) + seen.v * (c - a))
    apart = np.abs(levels[0] - levels[1])[surfaces[0].face >= 0]
    assert apart.max() < 0.06 * stride


def test_a_coarse_triangle_is_of_one_part() -> None:
    height, mask = np.zeros((96, 96), np.float32), np.ones((96, 96), bool)
    column = np.indices(mask.shape)[1]
    relief = build_relief(height, mask, parts=(column > 50).astype(int))
    assert relief.front is not None
    front = relief.faces[(relief.faces < relief.front).all(axis=1)]
    across = np.ptp(relief.vertices[front][..., 0], axis=1)
    middle = relief.vertices[front][..., 0].mean(axis=1)
    assert across[np.abs(middle - 51) < 1].max() <= 1
    assert across.max() > 4
