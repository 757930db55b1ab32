"""Compilation of loops over pixels."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import TypeVar, cast

from numba import njit

# Numba takes settings from a file in the current folder, which may be a downloaded project. It must
# not say whose compiled code is run; the environment outweighs that file.
os.environ.setdefault("NUMBA_CACHE_DIR", "")
os.environ.setdefault("NUMBA_CACHE_LOCATOR_CLASSES", "")

Kernel = TypeVar("Kernel", bound=Callable[..., object])


def compiled(kernel: Kernel) -> Kernel:
    """``kernel`` compiled by numba at its first call, and cached on disk. It releases the GIL."""
    return cast(Kernel, njit(cache=True, nogil=True, error_model="numpy")(kernel))
