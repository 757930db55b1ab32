"""The data set card: what a data set holds and how it was made."""

from __future__ import annotations

from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import Any

from lampblack import __version__

from .build import OCCLUSION_STEP, DatasetOptions
from .triple import BEHIND, DEPTH_STEPS, IN_FRONT, entry_paths


def dataset_card(folder: Path, options: DatasetOptions) -> dict[str, Any]:
    """JSON-able card of the data set in ``folder``, built with ``options``."""
    entries = Counter(path.parent.name for path in entry_paths(folder))
    settings = asdict(options)
    del settings["workers"]
    return {
        "lampblack": __version__,
        "options": settings,
        "entries": dict(entries),
        "arrays": {
            "drawings": "(K, H, W) uint8, 255 is full ink",
            "mask": "(H, ceil(W / 8)) uint8, packed bits",
            "normals": "(H, W, 3) int8, 127 is 1; x right, y up, z to the viewer",
            "depth": f"(H, W) uint16, 1/{DEPTH_STEPS} pixel a level, towards the viewer",
            "occlusion": f"(H, W) uint8, {IN_FRONT} on the nearer side, {BEHIND} behind it",
        },
        "occlusion_step": OCCLUSION_STEP,
        "licence": "that of the models",
    }
