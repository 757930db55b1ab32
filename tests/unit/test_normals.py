"""Prediction, its peers and its ground truth, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
import torch
from numpy.typing import NDArray

from lampblack.normals.card import NetworkCard
from lampblack.normals.character import MARGIN as CANVAS_MARGIN
from lampblack.normals.character import canvas_for, canvases, place
from lampblack.normals.network import shipped_network
from lampblack.normals.networks import CharacterNet, DilatedUNet, StridedUNet, build_network
from lampblack.normals.networks.dilated_unet import DILATIONS
from lampblack.normals.networks.torch_network import TorchNetwork
from lampblack.normals.predict import NormalPredictor
from lampblack.normals.predict_character import character_planes, mean_planes
from lampblack.normals.silhouette import flat_normals, inflated_normals, lumo_normals
from lampblack.normals.tiles import OUTSIDE, TILE, TileSource, diagonal_grids

Image = NDArray[np.float32]


def ball(size: int, radius: float) -> tuple[NDArray[np.bool_], Image]:
    """Mask and exact normals of a sphere in the middle of the picture."""
    rows, columns = np.mgrid[0:size, 0:size] + 0.5 - size / 2
    x, y = columns / radius, -rows / radius
    mask = np.hypot(x, y) < 1
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    return mask, (np.stack([x, y, z], axis=2) * mask[..., None]).astype(np.float32)


def angles(a: Image, b: Image) -> Image:
    return np.degrees(np.arccos(np.clip(np.einsum("...c,...c->...", a, b), -1, 1)))


def quiet_network(architecture: str, px: tuple[int, int] | None = None) -> NormalPredictor:
    """An untrained predictor: enough for all that does not depend on the weights."""
    torch.manual_seed(0)
    network = build_network(architecture)
    if isinstance(network, CharacterNet):  # it starts as Lumo, which would hide its faults
        torch.nn.init.normal_(network.normals.weight, std=0.02)
    px = px or ((96, 128) if architecture == "figure-net" else (256, 640))
    return NormalPredictor(TorchNetwork(network), NetworkCard(architecture, px))


both_kinds = pytest.mark.parametrize("architecture", ["figure-net", "dilated-unet"])


@pytest.mark.parametrize("peer", [lumo_normals, inflated_normals])
def test_peers_make_a_disk_a_hemisphere(peer: object) -> None:
    mask, truth = ball(200, 80.0)
    assert callable(peer)
    found = peer(mask)
    assert np.allclose(np.linalg.norm(found[mask], axis=1), 1, atol=1e-5)
    assert not found[~mask].any()
    assert angles(found, truth)[mask].mean() < 4.0
    assert angles(flat_normals(mask), truth)[mask].mean() > 30


def test_tile_holds_three_scales_about_one_centre() -> None:
    rng = np.random.default_rng(1)
    lines = rng.random((700, 600)).astype(np.float32)
    mask = np.ones(lines.shape, bool)
    tile = TileSource(lines, mask).cut(200, 160)
    assert np.array_equal(tile[0], lines[200:456, 160:416])
    assert np.allclose(tile[1, 64:192, 64:192], tile[0].reshape(128, 2, 128, 2).mean((1, 3)))
    assert np.allclose(tile[2, 96:160, 96:160], tile[0].reshape(64, 4, 64, 4).mean((1, 3)))
    assert (tile[3] == 1).all()


def test_tile_past_the_border_is_outside() -> None:
    tile = TileSource(np.ones((40, 40), np.float32), np.ones((40, 40), bool)).cut(-128, -128)
    assert (tile[0, :128] == OUTSIDE).all()
    assert (tile[0, 128:168, 128:168] == 1).all()
    assert tile[3].sum() == 40 * 40


@pytest.mark.parametrize("grids", [1, 3, 20])
def test_every_grid_covers_every_pixel_once(grids: int) -> None:
    for grid in diagonal_grids(500, 700, grids):
        seen = np.zeros((500 + 2 * TILE, 700 + 2 * TILE), int)
        for row, column in grid:
            seen[row + TILE : row + 2 * TILE, column + TILE : column + 2 * TILE] += 1
        assert (seen[TILE : TILE + 500, TILE : TILE + 700] == 1).all()


def test_network_is_the_papers_shape() -> None:
    network = DilatedUNet()
    assert [layer.dilation[0] for layer in network.dilated] == list(DILATIONS)  # type: ignore[index,union-attr]
    assert len(network.dilated) == 5
    assert network.leaky.negative_slope == 0.3
    tiles = torch.rand(2, 4, TILE, TILE)
    tiles[:, 3] = (tiles[:, 3] > 0.5).float()
    out = network(tiles)
    assert out.shape == (2, 3, TILE, TILE)
    assert out.abs().max() <= 1
    assert not (out * (1 - tiles[:, 3:4])).any()
    out.square().sum().backward()  # type: ignore[no-untyped-call]
    assert all(p.grad is not None and p.grad.abs().sum() > 0 for p in network.parameters())


def test_the_predecessor_sees_no_mask_and_has_its_size() -> None:
    network = StridedUNet()
    assert 4.4e6 < sum(p.numel() for p in network.parameters()) < 5.0e6
    tiles = torch.rand(1, 4, TILE, TILE)
    tiles[:, 3] = 1
    seen = network(tiles)
    tiles[:, 3, :, :100] = 0
    assert torch.allclose(network(tiles)[..., 100:], seen[..., 100:])
    assert torch.allclose(seen.norm(dim=1), torch.ones(1, TILE, TILE), atol=1e-4)


@pytest.mark.parametrize("shape", [(100, 100), (300, 80), (41, 333), (1, 900)])
def test_a_character_lies_in_the_middle_of_the_canvas_it_fills_best(shape: tuple[int, int]) -> None:
    canvas = canvas_for(shape, 256)
    assert canvas.shape in canvases(256)
    rows, columns = canvas.inner
    for side, size in zip((rows, columns), canvas.shape, strict=True):
        assert side.start == size - side.stop >= CANVAS_MARGIN - 1
    placed = place(np.ones((*shape, 1), np.float32), canvas)
    assert placed[canvas.inner].min() > 0.99
    assert placed.sum() == pytest.approx(placed[canvas.inner].sum())


def test_the_character_network_starts_as_lumo() -> None:
    torch.manual_seed(0)
    mask, _ = ball(300, 120.0)
    card = NetworkCard("figure-net", (256, 256), roundness=1.0)
    found = (
        NormalPredictor(TorchNetwork(build_network("figure-net")), card)
        .predict(mask * np.float32(0), mask)
        .normals
    )
    assert angles(found, lumo_normals(mask))[mask].mean() < 5


def test_every_canvas_counts_the_same_and_quick_sees_the_smallest_alone() -> None:
    mask, _ = ball(300, 120.0)
    lines = np.random.default_rng(0).random(mask.shape).astype(np.float32) * mask
    network = quiet_network("figure-net")._network
    large, _ = character_planes(network, 192, lines, mask)
    once, _ = mean_planes(network, (96, 192), lines, mask)
    twice, _ = mean_planes(network, (96, 96, 192), lines, mask)
    assert np.allclose(3 * twice - 2 * once, 2 * once - large, atol=1e-5)
    assert not np.allclose(once, large, atol=0.1)
    quick = quiet_network("figure-net", (96, 192)).predict(lines, mask, quick=True).normals
    small = quiet_network("figure-net", (96, 96)).predict(lines, mask).normals
    assert angles(quick, small)[mask].max() < 0.1


def test_a_mirrored_character_has_mirrored_normals() -> None:
    rng = np.random.default_rng(0)
    lines = rng.random((210, 143)).astype(np.float32)
    mask = rng.random((210, 143)) < 0.9
    mask[:, :60] |= True
    predictor = quiet_network("figure-net")
    here = predictor.predict(lines, mask).normals
    there = predictor.predict(lines[:, ::-1].copy(), mask[:, ::-1].copy()).normals[:, ::-1] * [
        -1,
        1,
        1,
    ]
    assert angles(here, there.astype(np.float32))[mask].mean() < 0.5


def test_depth_and_occlusions_come_with_the_normals() -> None:
    """Placed and mirrored as the normals are; depth is in pixels, so it grows with the drawing."""
    mask, _ = ball(300, 120.0)
    lines = np.random.default_rng(0).random(mask.shape).astype(np.float32) * mask
    predictor = quiet_network("figure-net")
    here, large, mirrored = (
        predictor.predict(drawn, inside)
        for drawn, inside in (
            (lines, mask),
            (lines.repeat(2, 0).repeat(2, 1), mask.repeat(2, 0).repeat(2, 1)),
            (lines[:, ::-1].copy(), mask[:, ::-1].copy()),
        )
    )
    assert here.depth is not None
    assert here.edge is not None
    assert large.depth is not None
    assert mirrored.depth is not None
    assert here.depth.std() > 1
    assert not here.depth[~mask].any()
    assert not here.edge[~mask].any()
    assert 0 < here.edge[mask].min() <= here.edge.max() < 1
    assert np.abs(mirrored.depth[:, ::-1] - here.depth).mean() < 0.02 * here.depth.std()
    shrunk = large.depth.reshape(300, 2, 300, 2).mean(axis=(1, 3))
    assert np.corrcoef(shrunk[mask], here.depth[mask])[0, 1] > 0.99
    assert shrunk[mask].std() == pytest.approx(2 * here.depth[mask].std(), rel=0.05)
    tiles = quiet_network("dilated-unet").predict(lines, mask)
    assert tiles.depth is None
    assert tiles.edge is None


def test_the_shipped_network_sees_a_ball_in_front_of_another() -> None:
    """Its depth tells which side of an inner outline is nearer, and it finds that outline."""
    size = 360
    rows, columns = np.mgrid[0:size, 0:size] + 0.5
    back = np.hypot(rows - 150, columns - 180) < 130
    front = np.hypot(rows - 240, columns - 180) < 80
    rim = (front & ~erode(front)) | (back & ~erode(back) & ~front)
    found = NormalPredictor().predict(rim.astype(np.float32), back | front)
    assert found.depth is not None
    assert found.edge is not None
    nearer = found.depth[170:190, 150:210].mean() - found.depth[130:150, 150:210].mean()
    assert nearer > 0.03 * size
    assert found.edge[155:165, 150:210].max() > 0.35 > 0.2 > found.edge[80:100, 150:210].max()


@both_kinds
def test_prediction_is_unit_inside_and_faces_the_viewer(architecture: str) -> None:
    mask, _ = ball(300, 120.0)
    lines = np.zeros(mask.shape, np.float32)
    found = quiet_network(architecture).predict(lines, mask).normals
    assert found.shape == (300, 300, 3)
    assert found.dtype == np.float32
    assert np.allclose(np.linalg.norm(found[mask], axis=1), 1, atol=1e-5)
    assert found[mask][:, 2].min() > 0
    assert not found[~mask].any()


@both_kinds
@pytest.mark.parametrize("size", [300, 900])
def test_a_shifted_character_keeps_its_normals_to_the_bit(architecture: str, size: int) -> None:
    """Everything is anchored to the character: no flicker under translation."""
    small, _ = ball(size, size * 0.4)
    mask = np.zeros((size + 60, size + 60), bool)
    moved = mask.copy()
    mask[:size, :size], moved[37 : 37 + size, 11 : 11 + size] = small, small
    lines = np.random.default_rng(0).random((size, size)).astype(np.float32) * small
    drawn, drawn_moved = (np.zeros(mask.shape, np.float32) for _ in range(2))
    drawn[:size, :size], drawn_moved[37 : 37 + size, 11 : 11 + size] = lines, lines
    predictor = quiet_network(architecture)
    here = predictor.predict(drawn, mask).normals[:size, :size]
    there = predictor.predict(drawn_moved, moved).normals[37 : 37 + size, 11 : 11 + size]
    assert np.array_equal(here, there)


@both_kinds
@pytest.mark.parametrize("shape", [(1, 1), (1, 40), (2000, 3), (5, 5)])
def test_specks_and_slivers_are_predicted(architecture: str, shape: tuple[int, int]) -> None:
    mask = np.ones(shape, bool)
    found = quiet_network(architecture).predict(np.ones(shape, np.float32), mask).normals
    assert np.allclose(np.linalg.norm(found, axis=2), 1, atol=1e-5)


def test_nothing_drawn_predicts_nothing() -> None:
    mask = np.zeros((30, 20), bool)
    predictor = quiet_network("figure-net")
    assert not predictor.predict(np.zeros((30, 20), np.float32), mask).normals.any()
    with pytest.raises(ValueError, match="grids"):
        predictor.predict(np.zeros((30, 20), np.float32), mask, grids=65)
    with pytest.raises(ValueError, match="equal"):
        predictor.predict(np.zeros((30, 21), np.float32), mask)


def test_grids_ask_the_papers_network() -> None:
    mask, _ = ball(200, 80.0)
    lines = (mask & ~erode(mask)).astype(np.float32)
    whole, tiled = (NormalPredictor().predict(lines, mask, grids=grids).normals for grids in (0, 1))
    paper = NormalPredictor(*shipped_network("dilated-unet"))
    assert np.array_equal(tiled, paper.predict(lines, mask, grids=1).normals)
    assert not np.array_equal(tiled, whole)


def test_shipped_network_rounds_a_ball() -> None:
    """The weights that ship know at least what a ball is, better than a flat card."""
    mask, truth = ball(420, 190.0)
    rim = mask & ~np.asarray(truth[..., 2] > 0.12)
    found = NormalPredictor().predict(rim.astype(np.float32), mask).normals
    assert angles(found, truth)[mask].mean() < 20


def test_a_character_cut_by_the_canvas_is_carried_on_and_a_touching_outline_is_not() -> None:
    mask, _ = ball(420, 190.0)
    rim = (mask & ~erode(mask)).astype(np.float32)
    whole = NormalPredictor().predict(rim, mask).normals
    cut = NormalPredictor().predict(rim[:, :210], mask[:, :210]).normals
    assert angles(cut, whole[:, :210])[mask[:, :210]].mean() < 15  # 30 when it is rounded off
    tight, lines = mask[20:400, 20:400], rim[20:400, 20:400]
    touching = NormalPredictor().predict(lines, tight).normals
    assert angles(touching, whole[20:400, 20:400])[tight].mean() < 6


def erode(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    inner = mask.copy()
    for axis, shift in ((0, 1), (0, -1), (1, 1), (1, -1)):
        for reach in (1, 2, 3):
            inner &= np.roll(mask, shift * reach, axis)
    return inner
