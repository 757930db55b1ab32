"""Loss of the character network: angle, certainty, depth and occlusions."""

from __future__ import annotations

import math
from dataclasses import dataclass

import torch
from torch import Tensor, nn

CERTAINTY, DEPTH, OCCLUSION = 0.03, 0.2, 0.02


@dataclass(frozen=True)
class Batch:
    """``fine`` (B, 2, H, W) ink and mask, ``coarse`` (B, 10, h, w), ``normals`` (B, 3, H, W),
    ``auxiliary`` (B, 3, h, w); all float32."""

    fine: Tensor
    coarse: Tensor
    normals: Tensor
    auxiliary: Tensor


@dataclass(frozen=True)
class Loss:
    """``total`` to minimise; ``angle`` in degrees, the mean over drawings of their means."""

    total: Tensor
    angle: float


def character_loss(found: tuple[Tensor, Tensor, Tensor], batch: Batch) -> Loss:
    """The mean angle over each character, and the auxiliary terms.

    Certainty is the negative log-likelihood of the angular von Mises-Fisher distribution (Bae
    2021); no gradient of it reaches the normals, so that hard places count as much as easy ones.
    """
    vectors, certainty, auxiliary = found
    mask = batch.fine[:, 1]
    pixels = mask.sum(dim=(1, 2)).clamp(min=1)
    unit = nn.functional.normalize(vectors, dim=1)
    angle = angles(unit, batch.normals)
    mean = ((angle * mask).sum(dim=(1, 2)) / pixels).mean()
    kappa = certainty[:, 0].clamp(-4, 5).exp()
    known = angle.detach()
    unlikely = -torch.log1p(kappa.square()) + kappa * known
    unlikely = unlikely + torch.log1p(torch.exp(-kappa * math.pi))
    sure = ((unlikely * mask).sum(dim=(1, 2)) / pixels).mean()
    cells = nn.functional.avg_pool2d(batch.fine[:, 1:], mask.shape[1] // auxiliary.shape[2])
    cells = (cells > 0.5).float()
    share = cells.sum().clamp(min=1)
    depth = ((auxiliary[:, :1] - batch.auxiliary[:, :1]).abs() * cells).sum() / share
    edges = nn.functional.binary_cross_entropy_with_logits(
        auxiliary[:, 1:], batch.auxiliary[:, 1:], reduction="none"
    )
    total = mean + CERTAINTY * sure + DEPTH * depth
    total = total + OCCLUSION * (edges * cells).sum() / share
    return Loss(total, math.degrees(float(mean.detach())))


def angles(a: Tensor, b: Tensor) -> Tensor:
    """Angle in radians between two (B, 3, H, W) maps of unit vectors: (B, H, W).

    Computed from the chord, because the derivative of the arc cosine is infinite at 0.
    """
    half = (a - b).square().sum(dim=1).add(1e-6).sqrt() / 2
    return 2 * torch.asin(half.clamp(max=0.9999))
