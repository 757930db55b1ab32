"""Loops over pixels, compiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar, cast

from numba import njit

Kernel = TypeVar("Kernel", bound=Callable[..., object])


def compiled(kernel: Kernel) -> Kernel:
    """``kernel`` compiled by numba at its first call, and kept on disk for the next start. Other
    threads go on while it runs."""
    return cast(Kernel, njit(cache=True, nogil=True)(kernel))
