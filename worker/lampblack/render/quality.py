"""How much work a render is given: every trade of speed against noise, in one place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class Sampling:
    """Resolution and samples of one kind of render.

    Attributes:
        scale: lighting pixels per canvas pixel, at most 1.
        longest: cap on the longer side of the render, lighting pixels.
        spp: samples per pixel.
    """

    scale: float
    longest: int
    spp: int

    def size(self, width: float, height: float) -> tuple[int, int]:
        """Lighting pixels (columns, rows) for ``width`` x ``height`` canvas pixels."""
        scale = min(self.scale, self.longest / max(width, height))
        return max(1, round(width * scale)), max(1, round(height * scale))


@dataclass(frozen=True)
class Quality:
    """Settings of one preset: ``light`` for each area light on the character, ``ambient`` for
    the ambient light on it, ``floor`` for the floor under each of them; ``mesh_stride`` is
    the pixels between two vertices of the relief."""

    light: Sampling
    ambient: Sampling
    floor: Sampling
    mesh_stride: int
    denoise: Literal["fast", "high"] = "fast"


QUALITIES: dict[str, Quality] = {
    "low": Quality(
        light=Sampling(0.5, 192, 4),
        ambient=Sampling(0.5, 128, 8),
        floor=Sampling(0.5, 96, 8),
        mesh_stride=4,
    ),
    "medium": Quality(
        light=Sampling(0.5, 512, 8),
        ambient=Sampling(0.5, 512, 16),
        floor=Sampling(0.5, 192, 16),
        mesh_stride=2,
    ),
    # Few samples at full resolution beat many at half of it: what is left after denoising is
    # not noise but steps in depth, where enlarged light leaks from one side to the other. For
    # the same reason neither adaptive sampling nor the slower denoiser earns its time.
    "final": Quality(
        light=Sampling(1.0, 4096, 5),
        ambient=Sampling(1.0, 4096, 7),
        floor=Sampling(0.25, 1024, 16),
        mesh_stride=1,
    ),
}

REFERENCE = Quality(
    light=Sampling(1.0, 4096, 512),
    ambient=Sampling(1.0, 4096, 512),
    floor=Sampling(1.0, 4096, 512),
    mesh_stride=1,
    denoise="high",
)
"""Every pixel, far too many samples: what the presets are judged against."""
