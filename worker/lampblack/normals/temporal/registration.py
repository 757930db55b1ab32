"""Registration: where each point of one drawing lies in another, and how reliable that is."""

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
"""Difference of features at which trust falls to 1/e."""
_ASTRAY = 2.0
"""Coarse cells between a point and itself mapped there and back, at which trust falls to 1/e."""
_BLUR = 1.5
_CUT = 0.2, 0.4
"""Mean trust over the character: below the first, the drawings have nothing in common and matches
are chance; above the second, they belong to one shot."""


@dataclass(frozen=True)
class Registration:
    """Where one drawing's coarse grid (h, w) lies in another drawing.

    Attributes:
        places: (2, h, w) float32, rows and columns on the other's coarse grid.
        trust: (h, w) float32 in 0..1; falls where the drawings differ, so that real changes are
            not averaged away.
    """

    places: Planes
    trust: NDArray[np.float32]

    def then(self, further: Registration) -> Registration:
        """This registration followed by ``further``, from the other drawing to a third."""
        planes = np.concatenate([further.places, further.trust[None]])
        seen = sampled(planes, self.places)
        return Registration(seen[:2], self.trust * seen[2])

    def fine(self) -> Registration:
        """The same registration on the fine grids of both drawings."""
        rows, columns = self.trust.shape
        at = np.asarray(np.indices((2 * rows, 2 * columns)) / 2 - 0.25, np.float32)
        seen = sampled(np.concatenate([self.places, self.trust[None]]), at)
        return Registration(2 * seen[:2] + 0.5, seen[2])

    def turn(self) -> NDArray[np.float32]:
        """(h, w) float32 local rotation in radians, anticlockwise."""
        smooth = ndimage.gaussian_filter(self.places, (0, 2, 2), mode="nearest")
        (down_down, down_right), (right_down, right_right) = (np.gradient(p) for p in smooth)
        angle: NDArray[np.float32] = np.arctan2(right_down - down_right, down_down + right_right)
        return angle


def registration(
    here: RegistrationThumbnail, other: RegistrationThumbnail, there: Planes, back: Planes
) -> Registration:
    """Registration of ``here`` with ``other``, from ``there = places_in(here, other)`` and
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
    """(2, h, w): where each coarse cell of ``here`` lies on the coarse grid of ``other``: a rigid
    motion of the whole, then the dense flow."""
    motion = rigid_motion(here.features, other.features, _start(here, other))
    at = np.indices(here.window.coarse, np.float32)
    flow = dense_flow(here.features, sampled(other.features, motion(at)))
    return motion(at + flow)


def rigid_registration(here: RegistrationThumbnail, other: RegistrationThumbnail) -> Registration:
    """Registration by the rigid motion of the whole character only, with full trust."""
    motion = rigid_motion(here.features, other.features, _start(here, other), finest=0)
    places = motion(np.indices(here.window.coarse, np.float32))
    return Registration(places, np.ones(here.window.coarse, np.float32))


def _start(here: RegistrationThumbnail, other: RegistrationThumbnail) -> Motion:
    """The first guess: centroids coincide, and both have the same size on the canvas."""
    scale = (other.window.coarse[0] / other.window.size[0]) / (
        here.window.coarse[0] / here.window.size[0]
    )
    return Motion(here.centre, other.centre, scale=scale)
