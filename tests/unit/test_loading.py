"""What is loaded before it is needed: the artist waits for it."""

from __future__ import annotations

import subprocess
import sys

import pytest

SLOW = {"numba", "onnxruntime", "scipy.interpolate", "scipy.optimize", "torch", "trimesh"}
"""Each takes a tenth of a second or more to load, torch two."""

FIRST_LOOK = """
from pathlib import Path
import numpy as np
from lampblack.cache import ArrayCache
from lampblack.drawing import DrawingPlanes
from lampblack.pipeline import Pipeline

disk = np.zeros((64, 64, 4), np.uint8)
disk[12:52, 12:52] = 120, 120, 120, 255
quick = Pipeline(ArrayCache(Path("nowhere"))).prepare_quick(DrawingPlanes(disk))
assert quick.height.max() > 1
"""


@pytest.mark.parametrize(
    ("statement", "used"),
    [
        pytest.param("import lampblack.render.client", set(), id="before the renderer is started"),
        pytest.param("import lampblack.render.trial", set(), id="by the renderer"),
        pytest.param("import lampblack.service.serve", {"numba"}, id="before the worker serves"),
        pytest.param(FIRST_LOOK, {"numba", "onnxruntime"}, id="for a first look at a drawing"),
    ],
)
def test_only_what_is_used_is_loaded(statement: str, used: set[str]) -> None:
    tell = f"{statement}\nimport sys\nprint(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", tell], capture_output=True, text=True, check=True)
    assert SLOW & set(run.stdout.split()) == used
