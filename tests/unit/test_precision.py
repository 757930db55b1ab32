"""Networks calculate in the format that the processor has, and say the same in both."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
import torch

from lampblack.normals.precision import fast_arithmetic, has_bf16
from lampblack.normals.predict import NormalPredictor


@pytest.fixture(autouse=True)
def _forgotten() -> Iterator[None]:
    has_bf16.cache_clear()
    yield
    has_bf16.cache_clear()


def on_a_processor(patch: pytest.MonkeyPatch, **has: bool) -> None:
    has_bf16.cache_clear()
    patch.setattr(torch.cpu, "get_capabilities", lambda: {"avx2": True, "avx512_f": True} | has)


@pytest.mark.parametrize(
    ("has", "dtype"),
    [
        ({}, torch.float32),
        ({"avx512_bf16": False, "amx_bf16": False}, torch.float32),
        ({"avx512_bf16": True}, torch.bfloat16),
        ({"amx_bf16": True}, torch.bfloat16),
    ],
)
def test_bf16_is_used_only_where_it_need_not_be_emulated(
    monkeypatch: pytest.MonkeyPatch, has: dict[str, bool], dtype: torch.dtype
) -> None:
    on_a_processor(monkeypatch, **has)
    with fast_arithmetic():
        assert (
            torch.nn.functional.conv2d(torch.ones(1, 1, 4, 4), torch.ones(1, 1, 3, 3)).dtype
            is dtype
        )


def test_the_shipped_network_says_the_same_in_both_formats(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rows, columns = np.mgrid[0:160, 0:120] + 0.5
    mask = np.hypot((rows - 80) / 76, (columns - 60) / 54) < 1
    lines = np.float32(0.9) * (mask & (np.abs(np.hypot(rows - 60, columns - 60) - 24) < 1.5))
    found = {}
    for has in (False, True):
        on_a_processor(monkeypatch, avx512_bf16=has)
        found[has] = NormalPredictor().predict(lines, mask, quick=True).normals
    between = np.einsum("...c,...c->...", found[False], found[True])[mask]
    assert not np.array_equal(found[False], found[True])
    assert np.degrees(np.arccos(np.clip(between, -1, 1))).mean() < 0.3
