"""Light passes: the light of each source on its own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..choices import DeviceKind


@dataclass(frozen=True)
class LightPasses:
    """The contribution of one white light of power 1, or of white ambient of strength 1.

    Scene-linear, row 0 at the top, (h, w, 3) float32 at the render's own resolution.

    Attributes:
        diffuse: irradiance over pi with the albedo divided out: a white wall fully lit is 1.
        glossy: reflected radiance of the glossy lobe with its own colour divided out.
        floor: irradiance over pi of the floor with the character: includes the character's shadow
            and the light that it reflects; None without a floor.
        open_floor: the same without the character.
            The shadow is the ratio of the two, each summed over the lights, since a light may
            reach the floor by way of the character alone.
    """

    diffuse: NDArray[np.float32]
    glossy: NDArray[np.float32]
    floor: NDArray[np.float32] | None = None
    open_floor: NDArray[np.float32] | None = None


DARK = LightPasses(*(np.zeros((1, 1, 3), np.float32) for _ in range(2)))
"""Stands for light that was not traced."""


@dataclass(frozen=True)
class Passes:
    """One frame's light.

    Attributes:
        lights: ``lights[i]`` belongs to ``scene.lights[i]``, and is dark where that does not shine.
        ambient: the ambient light of strength 1.
        emission: emissive colours, the brightest of them with an emission of 1; None without any.
        painted: painted light of power 1; None without any.
        mixture: all lights, in their colours and powers, traced as one. Then ``lights`` is empty;
            where the ambient light is part of it, ``ambient`` is dark.
        device: what traced all of it.
    """

    lights: tuple[LightPasses, ...]
    ambient: LightPasses
    emission: LightPasses | None = None
    painted: LightPasses | None = None
    mixture: LightPasses | None = None
    device: DeviceKind = "cpu"
