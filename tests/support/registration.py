"""How far two pictures of the same drawing are apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage


def luminance(picture: NDArray[np.uint8]) -> NDArray[np.float64]:
    """(H, W, 3) uint8 sRGB -> (H, W) float64 in 0..1, Rec. 709 weights on the coded values."""
    result: NDArray[np.float64] = picture[..., :3] @ np.array([0.2126, 0.7152, 0.0722]) / 255
    return result


def offset(first: NDArray[np.uint8], second: NDArray[np.uint8]) -> tuple[float, float]:
    """(right, down) in pixels by which ``second`` lies from ``first``.

    Phase correlation to the pixel, then Lucas and Kanade's least squares on the gradients.
    """
    a, b = luminance(first), luminance(second)
    spectrum = np.fft.fft2(a - a.mean()).conj() * np.fft.fft2(b - b.mean())
    peak = np.fft.ifft2(spectrum / np.maximum(np.abs(spectrum), 1e-9)).real
    rows, columns = np.unravel_index(np.argmax(peak), peak.shape)
    down = (int(rows) + a.shape[0] // 2) % a.shape[0] - a.shape[0] // 2
    right = (int(columns) + a.shape[1] // 2) % a.shape[1] - a.shape[1] // 2
    smooth = ndimage.gaussian_filter(a, 1.0)
    moved = ndimage.gaussian_filter(np.roll(b, (-down, -right), (0, 1)), 1.0)
    gradients = np.stack(np.gradient((smooth + moved) / 2), axis=-1).reshape(-1, 2)
    fine, *_ = np.linalg.lstsq(gradients, (smooth - moved).ravel(), rcond=None)
    return float(right + fine[1]), float(down + fine[0])
