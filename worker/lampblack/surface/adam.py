"""The paper's inflation: gradient descent with Adam on eq. 5 (section 3.2), for reference."""

from __future__ import annotations

import numpy as np
import torch
from numpy.typing import NDArray
from torch.nn.functional import conv2d

from .energy import KERNEL_X, KERNEL_Y, whole_windows

STEPS = 500
LEARNING_RATE = 1.0


def inflate_adam(
    normals: NDArray[np.float32],
    mask: NDArray[np.bool_],
    *,
    steps: int = STEPS,
    learning_rate: float = LEARNING_RATE,
) -> NDArray[np.float32]:
    """Heights after ``steps`` Adam steps from zero on ``energy_paper`` at gamma 1.

    The paper gives the kernels, the zero start and the 500 steps, but no learning rate.
    """
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    height = np.zeros(mask.shape, np.float32)
    if not len(rows):
        return height
    box = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
    inside = torch.from_numpy(whole_windows(mask)[box].astype(np.float32))
    n = torch.from_numpy(normals[box].astype(np.float32)).permute(2, 0, 1) * inside
    kernels = torch.from_numpy(np.stack([KERNEL_X, KERNEL_Y]))[:, None]
    z = torch.zeros((1, 1, *inside.shape), requires_grad=True)
    optimiser = torch.optim.Adam([z], lr=learning_rate, fused=True)
    for _ in range(steps):
        optimiser.zero_grad()
        residual = n[:2] + n[2] * conv2d(z, kernels, padding=1)[0]
        loss = residual.square().sum()
        loss.backward()  # type: ignore[no-untyped-call]
        optimiser.step()
    height[box] = z.detach().numpy()[0, 0]
    return np.where(mask, height, np.float32(0))
