"""Line drawings by Blender's Freestyle, the paper's renderer, made in a child process."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from lampblack.errors import RenderError

from .gbuffer import Placed

SECONDS_A_VIEW = 120


@dataclass(frozen=True)
class Stroke:
    """How Freestyle inks: ``width`` and ``wobble`` in pixels; lines that taper; creases of more
    than ``crease`` degrees, 0 for none; ``seed`` of the wobble, 0 to 999."""

    width: float = 3.0
    taper: bool = True
    wobble: float = 0.0
    crease: float = 0.0
    seed: int = 0

    @staticmethod
    def random(rng: np.random.Generator, character_px: int) -> Stroke:
        """A random stroke for a character of this size: thin pens to brushes."""
        return Stroke(
            width=float(np.exp(rng.uniform(np.log(0.0025), np.log(0.014)))) * character_px,
            taper=bool(rng.random() < 0.7),
            wobble=float(rng.choice([0.0, 0.0, rng.uniform(0.5, 2.0)])),
            crease=float(rng.choice([0.0, rng.uniform(60, 110)])),
            seed=int(rng.integers(1000)),
        )


def draw_freestyle(jobs: list[tuple[Placed, Stroke]]) -> list[NDArray[np.float32] | None]:
    """Draw the lines of every character: (H, W) float32 in 0..1, centred on the silhouette; None
    where Freestyle failed.

    Raises:
        RenderError: Blender cannot be run.
    """
    with tempfile.TemporaryDirectory(prefix="lampblack-") as name:
        folder = Path(name)
        for index, (placed, stroke) in enumerate(jobs):
            np.savez(
                folder / f"{index:04d}.npz",
                vertices=placed.vertices,
                faces=placed.faces,
                size=np.array(placed.size),
                width=stroke.width,
                taper=int(stroke.taper),
                wobble=stroke.wobble,
                crease=stroke.crease,
                seed=stroke.seed,
            )
        try:
            subprocess.run(
                [sys.executable, "-I", "-m", "lampblack_research.render.freestyle", name],
                cwd=os.sep,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                timeout=SECONDS_A_VIEW * (len(jobs) + 1),
                check=False,
            )
        except (OSError, subprocess.TimeoutExpired) as error:
            raise RenderError(
                "Freestyle could not draw the models.", "Try --lines gbuffer.", str(error)
            ) from error
        return [
            _read(folder / f"{index:04d}.png", placed.size)
            for index, (placed, _) in enumerate(jobs)
        ]


def _read(picture: Path, size: tuple[int, int]) -> NDArray[np.float32] | None:
    if not picture.exists():
        return None
    with Image.open(picture) as image:
        pixels = np.asarray(image.convert("RGBA"), np.float32) / 255.0
    if pixels.shape[:2] != size:
        return None
    ink: NDArray[np.float32] = pixels[..., 3] * (1 - pixels[..., :3].mean(axis=2))
    return ink
