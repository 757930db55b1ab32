"""White paper around a shadow has no blotches, and the shadow keeps its edge."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from lampblack.render.faint_change import without_blotches

SIZE = 96


def blotches() -> np.ndarray:
    """What a denoiser leaves: smooth noise of three hundredths at most."""
    noise = np.random.default_rng(4).normal(size=(SIZE, SIZE, 3))
    soft = ndimage.gaussian_filter(noise, (2, 2, 0))
    return (0.03 * soft / np.abs(soft).max()).astype(np.float32)


def test_paper_without_a_shadow_is_clean() -> None:
    found = without_blotches(blotches())
    assert np.abs(blotches()).max() > 0.029
    assert np.abs(found).max() < 0.008


@pytest.mark.parametrize("depth", [0.2, 0.9])
def test_a_shadow_keeps_its_edge_and_does_not_leak(depth: float) -> None:
    change = blotches()
    change[30:60, 20:70] -= np.float32(depth)
    found = without_blotches(change)
    inside = np.zeros((SIZE, SIZE), bool)
    inside[30:60, 20:70] = True
    assert np.abs(found - change)[inside].max() < 0.011
    assert np.abs(found)[~inside].max() < 0.008


def test_a_slow_fall_of_light_stays() -> None:
    """Of ambient light, from nothing at the left to six hundredths at the right."""
    slope = np.linspace(0, -0.06, SIZE, dtype=np.float32)
    wanted = np.repeat(np.tile(slope, (SIZE, 1))[..., None], 3, axis=2)
    found = without_blotches(wanted + blotches())
    middle = found[20:-20, 20:-20] - np.minimum(wanted + 0.01, 0)[20:-20, 20:-20]
    assert np.abs(middle).max() < 0.02
    assert middle.std() < 0.006
