"""Where each place of one drawing lies in another, and how far that can be trusted."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from .flow import dense_flow
from .rigid import Motion, rigid_motion
from .sample import sampled
from .thumbnail import RegistrationThumbnail
from .window import Planes

_MISMATCH = 0.18
"""Difference of features at which a place is trusted by 1/e."""
_ASTRAY = 2.0
"""Coarse cells by which there and back may miss, likewise."""
_BLUR = 1.5
_CUT = 0.2, 0.4
"""Mean trust over the figure below which the drawings have nothing in common, so that what
matches does so by chance; and above which they are of one shot."""


@dataclass(frozen=True)
class Registration:
    """One here seen from another's coarse grid (h, w).

    Attributes:
        places: (2, h, w) float32, rows and columns of the other's coarse grid.
        trust: (h, w) float32 in 0..1; falls where the drawings differ, so that what truly
            changes is not mixed.
    """

    places: Planes
    trust: NDArray[np.float32]

    def then(self, further: Registration) -> Registration:
        """What lies behind the other here, as ``further`` sees it from there."""
        planes = np.concatenate([further.places, further.trust[None]])
        seen = sampled(planes, self.places)
        return Registration(seen[:2], self.trust * seen[2])

    def fine(self) -> Registration:
        """The same on the fine grids of both."""
        rows, columns = self.trust.shape
        at = (np.indices((2 * rows, 2 * columns), np.float32) - 0.5) / 2
        seen = sampled(np.concatenate([self.places, self.trust[None]]), at)
        return Registration(2 * seen[:2] + 0.5, seen[2])

    def turn(self) -> NDArray[np.float32]:
        """(h, w) float32 angle in radians by which the drawing turns locally, anticlockwise."""
        smooth = ndimage.gaussian_filter(self.places, (0, 2, 2), mode="nearest")
        (down_down, down_right), (right_down, right_right) = (np.gradient(p) for p in smooth)
        angle: NDArray[np.float32] = np.arctan2(right_down - down_right, down_down + right_right)
        return angle


def registration(
    here: RegistrationThumbnail, other: RegistrationThumbnail, there: Planes, back: Planes
) -> Registration:
    """``other`` seen from ``here``, from ``there = places_in(here, other)`` and
    ``back = places_in(other, here)``."""
    at = np.indices(here.window.coarse, np.float32)
    mismatch = ((sampled(other.features, there) - here.features) ** 2).sum(axis=0)
    astray = ((sampled(back, there) - at) ** 2).sum(axis=0)
    doubt = ndimage.gaussian_filter(mismatch / _MISMATCH**2 + astray / _ASTRAY**2, _BLUR)
    trust = np.exp(-doubt)
    inside = here.features[0] > 0
    likeness = float(trust[inside].mean()) if inside.any() else 0.0
    trust *= np.clip((likeness - _CUT[0]) / (_CUT[1] - _CUT[0]), 0, 1)
    return Registration(there, trust.astype(np.float32))


def places_in(here: RegistrationThumbnail, other: RegistrationThumbnail) -> Planes:
    """(2, h, w): where each coarse cell of ``here`` lies on the coarse grid of ``other``: the
    rigid motion of the whole first, then each place's own."""
    motion = rigid_motion(here.features, other.features, _standing(here, other))
    at = np.indices(here.window.coarse, np.float32)
    flow = dense_flow(here.features, sampled(other.features, motion(at)))
    return motion(at + flow)


def rigid_registration(here: RegistrationThumbnail, other: RegistrationThumbnail) -> Registration:
    """``other`` where the motion of the whole figure alone would place it, fully trusted."""
    motion = rigid_motion(here.features, other.features, _standing(here, other), finest=0)
    places = motion(np.indices(here.window.coarse, np.float32))
    return Registration(places, np.ones(here.window.coarse, np.float32))


def _standing(here: RegistrationThumbnail, other: RegistrationThumbnail) -> Motion:
    """The figures laid over each other by their centroids, in equal size on the canvas."""
    scale = (other.window.coarse[0] / other.window.size[0]) / (
        here.window.coarse[0] / here.window.size[0]
    )
    return Motion(here.centre, other.centre, scale=scale)
