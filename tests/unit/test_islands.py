"""Islands are found run by run, as scipy labels regions element by element."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from lampblack.composite.islands import MOST_ISLANDS, small_regions, without_islands


@pytest.mark.parametrize("size", [(1, 1), (5, 8), (40, 63), (64, 64), (31, 97)])
@pytest.mark.parametrize("above", [True, False])
def test_small_regions_are_those_of_scipy(size: tuple[int, int], above: bool) -> None:
    noise = np.random.default_rng(size[1]).normal(size=size)
    plane = ndimage.gaussian_filter(noise, 1).astype(np.float32)
    level, smallest = np.float32(0.05), 12
    labels, count = ndimage.label(plane > level if above else plane < level)
    areas = np.bincount(labels.ravel(), minlength=count + 1)
    wanted = [n for n in range(1, count + 1) if areas[n] < smallest][:MOST_ISLANDS]
    found = small_regions(plane, level, smallest, above=above)
    assert len(found) == len(wanted)
    for island, number in zip(found, wanted, strict=True):
        inside = np.zeros(size, bool)
        for row, start, stop in island:
            inside[row, start:stop] = True
        assert np.array_equal(inside, labels == number)


def test_islands_take_the_light_around_them_and_the_rest_stays() -> None:
    amount = np.tile(np.linspace(0, 1, 60, dtype=np.float32), (60, 1))
    speckled = amount.copy()
    speckled[20:23, 8:10], speckled[40:42, 50:53] = 0.9, 0.05
    step = np.array([0.5], np.float32)
    found = without_islands(speckled, step, step, 30)
    assert np.abs(found - amount).max() < 0.1
    assert without_islands(amount, step, step, 30) is amount


def test_islands_that_cross_half_of_a_soft_step_go_too() -> None:
    """The top of a wide hill that is only just too low."""
    across, down = np.meshgrid(np.arange(60) - 30, np.arange(60) - 30)
    hill = 0.46 - 0.1 * (np.hypot(across, down) / 30).astype(np.float32) ** 2
    low, high = np.array([0.45], np.float32), np.array([0.55], np.float32)
    assert (hill > low).any()
    assert not (hill > high).any()
    assert not (without_islands(hill, low, high, 400) > low).any()
