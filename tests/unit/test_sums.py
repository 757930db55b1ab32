"""Sums and smoothing of light agree with the libraries that they are faster than."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from lampblack.composite.blur import blurred
from lampblack.composite.resample import Band, enlarge
from lampblack.composite.sums import add_up, brightest_of


def test_a_sum_is_of_enlarged_pictures() -> None:
    rng = np.random.default_rng(1)
    sizes = ((12, 9), (40, 31), (40, 20), (1, 1))
    pictures = [rng.uniform(0, 2, (*size, 3)).astype(np.float32) for size in sizes]
    pictures[0].flags.writeable = False
    weights = [rng.uniform(0, 2, 3).astype(np.float32) for _ in sizes]
    band = Band(31, 40, 0, 40)
    wanted = sum(w * enlarge(p, band) for w, p in zip(weights, pictures, strict=True))
    found = add_up(list(zip(weights, pictures, strict=True)))
    assert np.abs(found - wanted).max() < 1e-5
    assert np.array_equal(brightest_of(found), found.max(axis=2))
    assert not add_up([]).any()


@pytest.mark.parametrize("deviation", [0.5, 1.4, 6.0])
def test_smoothing_is_that_of_scipy(deviation: float) -> None:
    plane = np.random.default_rng(2).uniform(0, 1, (25, 18)).astype(np.float32)
    wanted = ndimage.gaussian_filter(plane, deviation, mode="nearest", truncate=3)
    assert np.abs(blurred(plane, deviation) - wanted).max() < 1e-6
