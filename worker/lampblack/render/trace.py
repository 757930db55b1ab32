"""One source's light: traced, denoised, and continued past the figure's edge."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .denoise import Denoiser
from .engine import render_passes
from .passes import LightPasses
from .stage import Stage
from .wire import Trace

FAINT = np.float32(0.05)
UNSEEN = 0.004  # half a step of an 8-bit picture: paper far from the figure stays as it was


def trace(stage: Stage, denoiser: Denoiser, job: Trace) -> LightPasses:
    """Trace the source of ``job`` over the surface and the floor on ``stage``.

    Raises:
        RuntimeError: Blender or the denoiser failed.
    """
    stage.set_canvas(job.canvas)
    stage.set_floor(job.floor, job.canvas)
    stage.set_source(job.light, job.canvas)
    sampling = job.quality.ambient if job.light is None else job.quality.light
    stage.set_sampling(sampling)
    stage.set_view(job.view, sampling.size(*job.view[2:]), job.canvas)
    stage.set_subject("figure")
    passes = render_passes(stage.scene)
    inside = passes["Combined"][..., 3] > 0.5
    guide = np.repeat(passes["Combined"][..., 3:], 3, axis=2)

    def light(kind: str) -> NDArray[np.float32]:
        there = inside & (passes[f"{kind} Color"] > 0).any(axis=2)
        if not there.any():
            return np.zeros_like(guide)
        noisy = np.nan_to_num(passes[f"{kind} Direct"] + passes[f"{kind} Indirect"])
        clean = denoiser.denoise(noisy, job.quality.denoise, guide, passes["Normal"])
        return fill(np.maximum(clean, 0), there)

    diffuse, glossy = light("Diffuse"), light("Glossy")
    if job.floor is None:
        return LightPasses(diffuse, glossy)
    stage.set_sampling(job.quality.floor)
    stage.set_view(job.view, job.quality.floor.size(*job.view[2:]), job.canvas)
    # Both renders draw the same random numbers, so their ratio is free of noise but in the
    # shadow and where light bleeds; FAINT keeps it tame where no light falls.
    cast, free = (_floor_light(stage, subject) + FAINT for subject in ("floor", "bare floor"))
    change = denoiser.denoise(cast / free, job.quality.denoise) - 1
    change -= np.clip(change, -UNSEEN, UNSEEN)
    floor = np.maximum(free - FAINT + change * free, 0)
    return LightPasses(diffuse, glossy, floor, free - FAINT)


def fill(image: NDArray[np.float32], inside: NDArray[np.bool_]) -> NDArray[np.float32]:
    """Give every pixel outside the value of the nearest inside, lest enlarging the picture
    draws a dark fringe along the edge. (h, w, 3), (h, w)."""
    row, column = ndimage.distance_transform_edt(
        ~inside, return_distances=False, return_indices=True
    )
    filled: NDArray[np.float32] = image[row, column]
    return filled


def _floor_light(stage: Stage, subject: str) -> NDArray[np.float32]:
    """Irradiance over pi of the floor, (h, w, 3)."""
    stage.set_subject(subject)  # type: ignore[arg-type]
    passes = render_passes(stage.scene)
    return np.nan_to_num(passes["Diffuse Direct"] + passes["Diffuse Indirect"])
