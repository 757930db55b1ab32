"""Quality presets: resolution and samples of every render."""

from __future__ import annotations

from dataclasses import dataclass, replace
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
    """Settings of one preset.

    Attributes:
        light: for each area light on the character.
        ambient: for the ambient light on the character.
        floor: for the floor under each light.
        mesh_stride: pixels between two vertices of the relief.
        denoise: quality of the denoiser.
    """

    light: Sampling
    ambient: Sampling
    floor: Sampling
    mesh_stride: int
    denoise: Literal["fast", "high"] = "fast"

    def mixture(self, lights: int) -> Sampling:
        """For so many lights and the ambient light traced as one. Each path meets one of the
        lights, and the ambient light for nothing. As measured, two lights have as little noise
        with 0.7 of the samples that they need apart, and one has with one sample more."""
        return replace(self.light, spp=max(self.light.spp + 1, 7 * self.light.spp * lights // 10))


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
    # Few samples at full resolution are better than many at half of it. After denoising, the
    # largest errors are at steps in depth, where enlarged light leaks from one side to the
    # other. Adaptive sampling and the slower denoiser do not help there.
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
"""Full resolution and very many samples: the reference for the presets."""
