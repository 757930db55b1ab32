"""Normals to heights: closed forms, what the energies promise, and what they must ignore."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest
from numpy.typing import NDArray

from lampblack.bench.inflate import bench_inflate, synthetic_character
from lampblack.errors import LampblackWarning
from lampblack.surface.adam import inflate_adam
from lampblack.surface.direct import inflate_direct
from lampblack.surface.energy import energy_compact, energy_paper
from lampblack.surface.guided import guided_filter
from lampblack.surface.solver import solve, usable_normals

Heights = NDArray[np.float32]
Normals = NDArray[np.float32]
Mask = NDArray[np.bool_]


def grid(rows: int, columns: int) -> tuple[Heights, Heights]:
    """x right and y up of the pixel centres, from the middle."""
    row, column = np.indices((rows, columns))
    x, y = column - (columns - 1) / 2, (rows - 1) / 2 - row
    return x.astype(np.float32), y.astype(np.float32)


def from_slopes(slope_x: Heights, slope_y: Heights, mask: Mask) -> Normals:
    """Normals of a surface with these slopes, y up."""
    n = np.stack([-slope_x, -slope_y, np.ones_like(slope_x)], axis=2)
    n /= np.linalg.norm(n, axis=2, keepdims=True)
    return np.asarray(n * mask[..., None], dtype=np.float32)


def sphere(size: int, radius: float) -> tuple[Normals, Mask, Heights]:
    x, y = grid(size, size)
    mask = np.hypot(x, y) < radius
    z = np.sqrt(np.maximum(radius**2 - x**2 - y**2, 0)).astype(np.float32)
    n = np.stack([x, y, z], axis=2) / np.float32(radius) * mask[..., None]
    return n.astype(np.float32), mask, z


def off(height: Heights, truth: Heights, where: Mask) -> float:
    """Greatest difference but for a constant."""
    difference = (height - truth)[where].astype(np.float64)
    return float(np.abs(difference - np.median(difference)).max())


def test_sphere_within_two_percent_of_its_radius() -> None:
    normals, mask, z = sphere(260, 120.0)
    height = solve(normals, mask)
    inner = z > 0.2 * 120
    assert off(height, z, inner) < 0.02 * 120
    assert off(height, z, mask) < 0.08 * 120
    assert (height[~mask] == 0).all()


def test_cone_within_one_percent_of_its_radius() -> None:
    x, y = grid(221, 201)
    distance = np.hypot(x, y)
    mask = distance < 95
    slope = np.float32(-0.8)
    safe = np.maximum(distance, 1e-6)
    height = solve(from_slopes(slope * x / safe, slope * y / safe, mask), mask)
    assert off(height, slope * distance, mask) < 0.01 * 95


@pytest.mark.parametrize(("slope_x", "slope_y"), [(0.5, 0.0), (0.0, 0.5), (-1.3, 0.7)])
def test_tilted_plane_rises_the_right_way(slope_x: float, slope_y: float) -> None:
    x, y = grid(60, 90)
    mask = np.ones((60, 90), bool)
    normals = from_slopes(np.full_like(x, slope_x), np.full_like(x, slope_y), mask)
    assert off(solve(normals, mask), slope_x * x + slope_y * y, mask) < 0.05


def test_no_checkerboard_from_noisy_normals() -> None:
    rng = np.random.default_rng(3)
    mask = np.ones((96, 96), bool)
    noise = rng.normal(scale=0.1, size=(2, 96, 96)).astype(np.float32)
    normals = usable_normals(from_slopes(noise[0], noise[1], mask), mask)
    row, column = np.indices(mask.shape)
    board = np.where((row + column) % 2, 1.0, -1.0)
    height = inflate_direct(normals, mask)
    assert abs((height * board).mean()) < 0.002
    # The paper's kernels cannot see a checkerboard; the compact stencil must.
    checked = (height + board).astype(np.float32)
    paper = energy_paper(height, normals, mask)
    assert energy_paper(checked, normals, mask) == pytest.approx(paper, rel=1e-4)
    assert energy_compact(checked, normals, mask) > 100 * energy_compact(height, normals, mask)


def test_parts_rest_on_their_own_borders() -> None:
    normals, mask, z = sphere(100, 40.0)
    both = np.concatenate([normals, normals], axis=1)
    both_mask = np.concatenate([mask, mask], axis=1)
    height = solve(both, both_mask)
    left, right = height[:, :100], height[:, 100:]
    np.testing.assert_allclose(left, right, atol=0.05)
    assert off(left, z, z > 0.2 * 40) < 0.03 * 40
    border = mask & (np.hypot(*grid(100, 100)) > 39.3)
    assert abs(float(left[border].mean())) < 0.1 * 40


def test_holes_single_pixels_and_empty_masks() -> None:
    normals, mask, z = sphere(160, 70.0)
    x, y = grid(160, 160)
    mask &= np.hypot(x - 15, y + 10) > 12
    mask[0, 0] = mask[-1, 40] = True
    normals = np.where(mask[..., None], normals, 0)
    normals[0, 0] = normals[-1, 40] = (0, 0.6, 0.8)
    height = solve(normals, mask)
    assert off(height, z, mask & (z > 0.2 * 70)) < 0.02 * 70
    assert height[0, 0] == 0
    assert not solve(normals, np.zeros_like(mask)).any()


def test_thin_and_nearly_cut_characters_converge() -> None:
    """A one pixel wide spiral, and a line of rim normals through the middle of a plane."""
    mask = np.zeros((61, 61), bool)
    for ring in range(1, 30, 4):
        mask[ring, ring:-ring] = mask[-ring - 1, ring:-ring] = True
        mask[ring:-ring, ring] = mask[ring:-ring, -ring - 1] = True
        mask[ring + 1, ring] = False
        mask[ring + 2, ring : ring + 5] = True
    x, _ = grid(61, 61)
    slope = np.full_like(x, 0.5)
    height = solve(from_slopes(slope, 0 * x, mask), mask)
    assert np.ptp((height - 0.5 * x)[mask]) < 0.2 * 61
    rim = np.abs(x) < 1
    cut = from_slopes(np.where(rim, 19.0, 0.5).astype(np.float32), 0 * x, np.ones_like(mask))
    height = solve(cut, np.ones_like(mask))
    assert np.abs(np.diff(height[:, :29], axis=1) - 0.5).max() < 0.01
    assert np.abs(np.diff(height, axis=0)).max() < 0.01


def test_least_energy_scales_with_one_over_gamma() -> None:
    normals, mask = synthetic_character(80)
    usable = usable_normals(normals, mask)
    height = inflate_direct(usable, mask)
    gamma = 2.5
    at_one = energy_compact(height, usable, mask)
    assert energy_compact(height / gamma, usable, mask, gamma) == pytest.approx(at_one, rel=1e-5)
    rng = np.random.default_rng(0)
    for scale in (0.01, 0.3):
        moved = height / gamma + rng.normal(scale=scale, size=mask.shape).astype(np.float32)
        assert energy_compact(moved, usable, mask, gamma) > at_one
    assert energy_compact(height * 1.01, usable, mask) > at_one


def test_direct_is_no_worse_than_adam_in_both_discretisations() -> None:
    normals, mask, _ = sphere(140, 64.0)
    figures = bench_inflate(normals, mask)
    assert figures["masked_pixels"] == np.count_nonzero(mask)
    assert figures["energy_direct"] <= figures["energy_adam"]
    assert figures["energy_direct_compact"] <= figures["energy_adam_compact"]
    assert figures["speedup_direct_over_adam"] == pytest.approx(
        figures["seconds_adam"] / figures["seconds_direct"]
    )


def test_noise_is_not_fitted() -> None:
    """Eq. 6 lets Adam fit noise with ripples; the compact stencil stays nearer the truth."""
    normals, mask = synthetic_character(160)
    truth = usable_normals(normals, mask)
    noise = np.random.default_rng(5).normal(scale=0.3, size=normals.shape)
    noisy = usable_normals(normals + noise, mask)
    direct, adam = inflate_direct(noisy, mask), inflate_adam(noisy, mask)
    assert energy_paper(direct, truth, mask) < 0.7 * energy_paper(adam, truth, mask)
    assert energy_compact(direct, noisy, mask) < 0.1 * energy_compact(adam, noisy, mask)


def test_adam_descends_on_the_energy_of_the_paper() -> None:
    normals, mask = synthetic_character(60)
    usable = usable_normals(normals, mask)
    flat = energy_paper(np.zeros(mask.shape, np.float32), usable, mask)
    few = energy_paper(inflate_adam(usable, mask, steps=20), usable, mask)
    many = energy_paper(inflate_adam(usable, mask, steps=200), usable, mask)
    assert many < few < flat


def test_bad_normals_are_carried_across() -> None:
    normals, mask, z = sphere(120, 50.0)
    normals[50:53, 60:64] = np.nan
    normals[70, 70] = 0
    normals[40, 40] = np.inf
    with pytest.warns(LampblackWarning, match="14 pixels"):
        height = solve(3 * normals, mask)
    assert off(height, z, z > 0.2 * 50) < 0.04 * 50
    with pytest.warns(LampblackWarning):
        assert not solve(np.full((8, 8, 3), np.nan), np.ones((8, 8), bool)).any()


def test_wrong_shapes_and_solvers_are_refused() -> None:
    with pytest.raises(ValueError, match="not"):
        solve(np.zeros((4, 4)), np.ones((4, 4), bool))
    with pytest.raises(ValueError, match="not"):
        solve(np.zeros((4, 4, 3)), np.ones((4, 5), bool))
    with pytest.raises(ValueError, match="no solver"):
        solve(np.zeros((4, 4, 3)), np.ones((4, 4), bool), "magic")  # type: ignore[arg-type]


def test_guided_filter_keeps_slopes_rims_and_creases() -> None:
    x, y = grid(120, 140)
    mask = np.hypot(x / 60, y / 50) < 1
    roof = (-0.7 * np.abs(x) + 0.3 * y).astype(np.float32) * mask
    kept = guided_filter(roof, mask)
    assert np.abs(kept - roof)[mask].max() < 0.15
    away = mask & (np.abs(x) > 8)
    assert np.abs(kept - roof)[away].max() < 0.03
    assert (kept[~mask] == 0).all()


def test_guided_filter_reads_nothing_outside_and_calms_noise() -> None:
    _, mask, z = sphere(200, 90.0)
    rng = np.random.default_rng(1)
    noisy = z + rng.normal(scale=0.1, size=z.shape).astype(np.float32)
    filtered = guided_filter(noisy, mask)
    np.testing.assert_array_equal(filtered, guided_filter(np.where(mask, noisy, 1e4), mask))
    inner = z > 0.4 * 90
    assert (filtered - z)[inner].std() < 0.6 * (noisy - z)[inner].std()
    assert np.abs(guided_filter(z, mask) - z)[mask].max() < 0.01 * 90


def test_a_height_is_the_same_on_any_number_of_cores() -> None:
    """BLAS shares long sums out to threads, and rounds them as it does so."""
    program = (
        "import hashlib, numpy as np\n"
        "from lampblack.surface import solve\n"
        "y, x = np.mgrid[-1:1:300j, -1:1:300j].astype(np.float32)\n"
        "z = np.sqrt(np.clip(1 - x * x - y * y, 0.01, 1))\n"
        "mask = np.hypot(x, y) < 0.95\n"
        "normals = (np.dstack([x, -y, z]) * mask[..., None]).astype(np.float32)\n"
        "print(hashlib.sha256(solve(normals, mask).tobytes()).hexdigest())\n"
    )
    found = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "OPENBLAS_NUM_THREADS": threads},
            capture_output=True,
            check=True,
        ).stdout
        for threads in ("1", "2")
    }
    assert len(found) == 1
