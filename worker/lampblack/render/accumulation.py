"""Light of one source, accumulated over several short renders, since a render cannot be
interrupted."""

from __future__ import annotations

from dataclasses import dataclass, field

import msgspec
import numpy as np
from numpy.typing import NDArray

from .denoise import Denoiser
from .engine import render_passes
from .stage import Stage
from .trace import character_light, floor_light, floor_passes, own_floor_light
from .wire import Accumulate

Floats = NDArray[np.float32]


@dataclass
class Accumulation:
    """The samples so far. ``views`` has the summed passes of one render; for the floor, those of
    the renders with and without the character."""

    job: Accumulate | None = None
    spp: int = 0
    views: list[dict[str, Floats]] = field(default_factory=list)

    def accumulate(self, stage: Stage, denoiser: Denoiser, job: Accumulate) -> tuple[Floats, ...]:
        """Trace and add the samples of ``job``. Returns the light so far if it is to be resolved:
        diffuse and glossy light of the character, or the floor's light with and without the
        character, (h, w, 3).

        Raises:
            RuntimeError: Blender or the denoiser failed, or ``job`` continues another accumulation.
        """
        if job.first == 0:
            self.job, self.spp, self.views = job, 0, []
        if self.job is None or _setting(job) != _setting(self.job) or job.first != self.spp:
            raise RuntimeError("the accumulation to continue is not the current one")
        if job.count:
            self._add(stage, job)
        if not job.resolve:
            return ()
        views = [_divided(sums, self.spp) for sums in self.views]
        if job.subject == "character":
            return character_light(views[0], denoiser, "fast")
        if job.glow == "emission":
            light = own_floor_light(views[0], denoiser, "fast")
            return light, light
        return floor_light(views[0], views[1], denoiser, "fast")

    def _add(self, stage: Stage, job: Accumulate) -> None:
        stage.set_canvas(job.canvas)
        stage.set_floor(job.floor, job.canvas)
        stage.set_source(job.light, job.canvas, job.glow)
        stage.set_samples(job.spp, job.first, job.count)
        stage.set_view(job.view, job.size, job.canvas)
        if job.subject == "character":
            stage.set_subject("character")
            views = [render_passes(stage.scene)]
        elif job.glow == "emission":
            views = [floor_passes(stage, "floor")]
        else:
            views = [floor_passes(stage, subject) for subject in ("floor", "bare floor")]
        weighted = [_multiplied(view, job.count) for view in views]
        if self.views:
            for sums, more in zip(self.views, weighted, strict=True):
                for name, total in sums.items():
                    total += more[name]
        else:
            self.views = weighted
        self.spp += job.count


def _multiplied(view: dict[str, Floats], spp: int) -> dict[str, Floats]:
    """Passes that can be summed: Cycles divides light by the colour of its samples, which differs
    between samples on the outline."""
    return {
        name: np.nan_to_num(seen) * spp * view.get(_colour_of(name), 1)
        for name, seen in view.items()
    }


def _divided(sums: dict[str, Floats], spp: int) -> dict[str, Floats]:
    """Summed passes, as Cycles would give them for all ``spp`` samples in one render."""
    mean = {name: total / float(spp) for name, total in sums.items()}
    for name in mean:
        colour = mean.get(_colour_of(name))
        if colour is not None:
            lit = np.divide(mean[name], colour, where=colour > 0, out=np.zeros_like(mean[name]))
            mean[name] = lit
    return mean


def _colour_of(name: str) -> str:
    """The name of the colour pass by which a light pass is divided; empty for other passes."""
    kind, _, part = name.partition(" ")
    return f"{kind} Color" if part in ("Direct", "Indirect") else ""


def _setting(job: Accumulate) -> Accumulate:
    return msgspec.structs.replace(job, first=0, count=0, resolve=False)
