"""Errors of normals against the truth, and measures of roundness."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from lampblack.normals.follow_strokes import divergence

RIM_SHARE = 0.006
"""Width of the rim as a share of the character's size: 3 pixels of 512."""

CURVED = 1.0
"""Smallest divergence of the normals that counts as curved. A ball as large as the character
has 4."""


@dataclass(frozen=True)
class Errors:
    """Errors of one drawing, over the pixels of the character.

    Attributes:
        mean, median: angle, degrees.
        l1: mean over pixels of the mean absolute difference of the three components.
        l2: mean over pixels of the length of the difference, over the root of 3.
        under_11, under_22, under_30: percent of pixels under 11.25, 22.5 and 30 degrees.
        tilt: mean angle between predicted normal and view, degrees; truth_tilt likewise.
        rim: mean elevation above the picture plane along the silhouette; truth_rim likewise.
        curvature: percent of curved pixels whose divergence has the sign of the truth's.
        concave: the same, of hollow pixels only; nan if there are none.
        dented: percent of round pixels that are hollow; nan if there are none.
    """

    mean: float
    median: float
    l1: float
    l2: float
    under_11: float
    under_22: float
    under_30: float
    tilt: float
    truth_tilt: float
    rim: float
    truth_rim: float
    curvature: float
    concave: float
    dented: float


def measure(
    found: NDArray[np.float32], truth: NDArray[np.float32], mask: NDArray[np.bool_]
) -> Errors:
    """Compare two (H, W, 3) maps of unit normals inside ``mask``."""
    a, b = found[mask], truth[mask]
    angle = np.degrees(np.arccos(np.clip(np.einsum("nc,nc->n", a, b), -1, 1)))
    distance = ndimage.distance_transform_edt(np.pad(mask, 1))[1:-1, 1:-1]
    rim = mask & (distance <= max(1.0, RIM_SHARE * max(mask.shape)))
    curvature, concave, dented = _same_curvature(found, truth, mask)
    return Errors(
        mean=float(angle.mean()),
        median=float(np.median(angle)),
        l1=float(np.abs(a - b).mean()),
        l2=float((np.linalg.norm(a - b, axis=1) / np.sqrt(3)).mean()),
        under_11=100 * float((angle < 11.25).mean()),
        under_22=100 * float((angle < 22.5).mean()),
        under_30=100 * float((angle < 30).mean()),
        tilt=_tilt(a),
        truth_tilt=_tilt(b),
        rim=90 - _tilt(found[rim]),
        truth_rim=90 - _tilt(truth[rim]),
        curvature=curvature,
        concave=concave,
        dented=dented,
    )


def means(rows: list[Errors]) -> dict[str, float]:
    """Mean of every measure over the drawings that have it."""
    columns = {f.name: np.array([getattr(row, f.name) for row in rows]) for f in fields(Errors)}
    known = {name: values[np.isfinite(values)] for name, values in columns.items()}
    return {
        name: round(float(values.mean()), 4) if len(values) else float("nan")
        for name, values in known.items()
    }


def bootstrap(
    ours: list[float], theirs: list[float], models: list[str], rounds: int = 2000
) -> tuple[float, float]:
    """95 % interval of the relative gain ``1 - ours / theirs`` of mean angles; whole models are
    resampled, because drawings of one model are alike."""
    rng = np.random.default_rng(0)
    names = sorted(set(models))
    by_model = np.array(
        [
            [np.mean([angle for angle, m in zip(angles, models, strict=True) if m == name])]
            for angles in (ours, theirs)
            for name in names
        ]
    ).reshape(2, len(names))
    picks = rng.integers(len(names), size=(rounds, len(names)))
    gains = 1 - by_model[0][picks].mean(axis=1) / by_model[1][picks].mean(axis=1)
    low, high = np.quantile(gains, [0.025, 0.975])
    return float(low), float(high)


def _tilt(normals: NDArray[np.float32]) -> float:
    return float(np.degrees(np.arccos(np.clip(normals[:, 2], -1, 1))).mean())


def bend(normals: NDArray[np.float32], mask: NDArray[np.bool_]) -> NDArray[np.float32]:
    """(H, W) divergence of (H, W, 3) normals, smoothed, per size of the character: above 0 where
    the surface is round, below 0 where it is hollow. 0 outside and at the border of ``mask``."""
    size = max(mask.shape)
    inner = ndimage.binary_erosion(mask, iterations=max(2, size // 100))
    return np.asarray(size * divergence(normals, mask, size / 128) * inner, np.float32)


def _same_curvature(
    found: NDArray[np.float32], truth: NDArray[np.float32], mask: NDArray[np.bool_]
) -> tuple[float, float, float]:
    """Percent of the curved and of the hollow pixels with the right sign, and of the round ones
    with the wrong one."""
    ours, true = bend(found, mask), bend(truth, mask)
    same = np.sign(ours) == np.sign(true)
    hollow, rounded = true < -CURVED, true > CURVED
    curved = hollow | rounded
    return (
        100 * float(same[curved].mean()) if curved.any() else 100.0,
        100 * float(same[hollow].mean()) if hollow.any() else float("nan"),
        100 * float((ours < 0)[rounded].mean()) if rounded.any() else float("nan"),
    )
