"""Tracing the light of one source: denoised, and continued past the character's edge."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .denoise import DenoiseQuality, Denoiser
from .engine import render_passes
from .faint_change import without_blotches
from .passes import LightPasses
from .stage import Stage
from .wire import Trace

Floats = NDArray[np.float32]

FAINT = np.float32(0.05)


def trace(stage: Stage, denoiser: Denoiser, job: Trace) -> LightPasses:
    """Trace the source of ``job`` on the surface and the floor of ``stage``.

    Raises:
        RuntimeError: Blender or the denoiser failed.
    """
    stage.set_canvas(job.canvas)
    stage.set_floor(job.floor, job.canvas)
    if job.mixture is not None:
        stage.set_sources(job.mixture.lights, job.mixture.ambient, job.canvas)
        sampling = job.quality.mixture(len(job.mixture.lights))
    else:
        stage.set_source(job.light, job.canvas, job.glow)
        sampling = job.quality.ambient if job.light is None else job.quality.light
    stage.set_sampling(sampling)
    stage.set_subject("character")
    diffuse, glossy = _of_character(stage, denoiser, job, sampling.size(*job.view[2:]))
    if job.floor is None:
        return LightPasses(diffuse, glossy)
    stage.set_sampling(job.quality.floor)
    stage.set_view(job.view, job.quality.floor.size(*job.view[2:]), job.canvas)
    if job.glow == "emission":
        light = own_floor_light(floor_passes(stage, "floor"), denoiser, job.quality.denoise)
        return LightPasses(diffuse, glossy, light, light)
    cast, free = (floor_passes(stage, subject) for subject in ("floor", "bare floor"))
    return LightPasses(diffuse, glossy, *floor_light(cast, free, denoiser, job.quality.denoise))


def _of_character(
    stage: Stage, denoiser: Denoiser, job: Trace, size: tuple[int, int]
) -> tuple[Floats, Floats]:
    """Diffuse and glossy light of ``size`` (columns, rows). Only the box of the character is
    rendered, and continued past its edges."""
    view, whole = np.array(job.view), np.array(size)
    step = view[2:] / whole
    low, high = (stage.character_box() - view[:2]) / step
    first = np.clip(np.floor(low).astype(int), 0, whole - 1)
    last = np.clip(np.ceil(high).astype(int), first + 1, whole)
    (left, top), (right, bottom) = first.tolist(), last.tolist()
    x, y, width, height = np.concatenate([view[:2] + first * step, (last - first) * step]).tolist()
    stage.set_view((x, y, width, height), (right - left, bottom - top), job.canvas)
    found = character_light(render_passes(stage.scene), denoiser, job.quality.denoise)
    around = (top, size[1] - bottom), (left, size[0] - right), (0, 0)
    diffuse, glossy = (np.pad(light, around, "edge") for light in found)
    return diffuse, glossy


def character_light(
    passes: dict[str, Floats], denoiser: Denoiser, quality: DenoiseQuality
) -> tuple[Floats, Floats]:
    """Diffuse and glossy light on the character without their colour, denoised, (h, w, 3)."""
    diffuse, glossy = (_clean(passes, kind, denoiser, quality) for kind in ("Diffuse", "Glossy"))
    return diffuse, glossy


def floor_light(
    cast: dict[str, Floats], free: dict[str, Floats], denoiser: Denoiser, quality: DenoiseQuality
) -> tuple[Floats, Floats]:
    """Irradiance over pi of the floor with the character on it and without, (h, w, 3), from the
    passes of both.

    Both renders use the same random numbers, so their ratio has noise only where the character
    casts a shadow or reflects light. FAINT bounds it where no light falls.
    """
    open_floor = _irradiance(free)
    ratio = (_irradiance(cast) + FAINT) / (open_floor + FAINT)
    change = without_blotches(denoiser.denoise(ratio, quality) - 1)
    return np.maximum(open_floor + change * (open_floor + FAINT), 0), open_floor


def own_floor_light(cast: dict[str, Floats], denoiser: Denoiser, quality: DenoiseQuality) -> Floats:
    """Irradiance over pi that the character itself gives to the floor, (h, w, 3). It counts as
    light without the character too: it fills shadows, and paper is never brighter than drawn."""
    return np.maximum(denoiser.denoise(_irradiance(cast), quality), 0)


def floor_passes(stage: Stage, subject: Literal["floor", "bare floor"]) -> dict[str, Floats]:
    """Render the passes of the floor, with or without the character."""
    stage.set_subject(subject)
    return render_passes(stage.scene)


def fill(image: Floats, inside: NDArray[np.bool_]) -> Floats:
    """Give every pixel outside the value of the nearest pixel inside, so that enlarging adds no
    dark fringe. ``image`` is (h, w, 3), ``inside`` (h, w)."""
    row, column = ndimage.distance_transform_edt(
        ~inside, return_distances=False, return_indices=True
    )
    filled: Floats = image[row, column]
    return filled


def _clean(
    passes: dict[str, Floats], kind: str, denoiser: Denoiser, quality: DenoiseQuality
) -> Floats:
    """One kind of light on the character without its colour, denoised, (h, w, 3).

    Filled before it is denoised, because the denoiser would blur the dark outside into the edge.
    """
    there = (passes["Combined"][..., 3] > 0.5) & (passes[f"{kind} Color"] > 0).any(axis=2)
    light = np.nan_to_num(passes[f"{kind} Direct"] + passes[f"{kind} Indirect"])
    if not there.any():
        return np.zeros_like(light)
    top, bottom, left, right = _bounding_box(there)
    box = slice(top, bottom), slice(left, right)
    clean = denoiser.denoise(fill(light[box], there[box]), quality)
    height, width = there.shape
    around = (top, height - bottom), (left, width - right), (0, 0)
    return np.pad(np.maximum(clean, 0), around, "edge")


def _bounding_box(mask: NDArray[np.bool_]) -> tuple[int, int, int, int]:
    """(top, bottom, left, right), ends excluded."""
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    return int(rows[0]), int(rows[-1]) + 1, int(columns[0]), int(columns[-1]) + 1


def _irradiance(passes: dict[str, Floats]) -> Floats:
    """Irradiance over pi, (h, w, 3)."""
    return np.asarray(np.nan_to_num(passes["Diffuse Direct"] + passes["Diffuse Indirect"]))
