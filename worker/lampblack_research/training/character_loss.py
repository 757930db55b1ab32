"""Loss of the character network: angle, bend, certainty, depth, depth order, occlusions, marks."""

from __future__ import annotations

import math
from dataclasses import dataclass

import torch
from torch import Tensor, nn

from lampblack.normals.character import COARSE

CERTAINTY, DEPTH, OCCLUSION = 0.03, 0.4, 0.05
DIFFERENCE, ORDER = 1.0, 0.05
MARK, BEND = 0.2, 0.01
SEEN = (2.0, 4.0)
"""Weight of cells on the near and on the far side of an occlusion: they are few."""
MARK_SEEN = 3.0
"""Weight of cells whose ink is of marks: they are fewer than those of lines."""
REACHES = (1, 2, 4)
"""Distances, in cells, over which differences of depth are compared."""
JUMP = 0.02
"""Differences of depth above this, in sides of the canvas, count as an occlusion."""
JUMP_WEIGHT = 5.0
HOLLOW_WEIGHT = 2.0
"""Weight of cells where the surface is hollow: they are fewer than round ones."""
CURVED = 1.0
"""Smallest change of the normals, over the side of the canvas, that counts as a bend. A ball as
large as the canvas has 4."""
MARGIN = 0.02
"""Scale of the ordinal loss: a predicted order is sure from about this difference of depth."""


@dataclass(frozen=True)
class Batch:
    """``fine`` (B, 2, H, W) ink and mask, ``coarse`` (B, 11, h, w), ``normals`` (B, 3, H, W),
    ``auxiliary`` (B, 4, h, w), the last of it -1 where there is no ink; all float32."""

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
        auxiliary[:, 1:3],
        batch.auxiliary[:, 1:3],
        reduction="none",
        pos_weight=auxiliary.new_tensor(SEEN)[:, None, None],
    )
    difference, order = pair_losses(auxiliary[:, 0], batch.auxiliary[:, 0], cells[:, 0] > 0.5)
    total = mean + CERTAINTY * sure + DEPTH * depth + DIFFERENCE * difference + ORDER * order
    total = total + OCCLUSION * (edges * cells).sum() / share
    total = total + MARK * mark_loss(auxiliary[:, 3], batch.auxiliary[:, 3])
    total = total + BEND * bend_loss(unit, batch.normals, mask)
    return Loss(total, math.degrees(float(mean.detach())))


def pair_losses(found: Tensor, truth: Tensor, inside: Tensor) -> tuple[Tensor, Tensor]:
    """Losses of pairs of cells: the difference of their depths, and their order where one
    occludes the other.

    Args:
        found, truth: (B, h, w) depth in sides of the canvas. inside: (B, h, w) bool.

    Returns:
        The weighted mean absolute error of the difference, occluding pairs counting
        ``JUMP_WEIGHT`` times; and the mean ordinal loss ``softplus(-sign x difference)`` over
        the occluding pairs.
    """
    errors = weights = orders = jumps = found.new_zeros(())
    for reach in REACHES:
        for axis in (1, 2):
            count = found.shape[axis] - reach
            near = [t.narrow(axis, 0, count) for t in (found, truth)]
            far = [t.narrow(axis, reach, count) for t in (found, truth)]
            both = inside.narrow(axis, 0, count) & inside.narrow(axis, reach, count)
            ours, true = near[0] - far[0], near[1] - far[1]
            jump = (both & (true.abs() > JUMP * reach**0.5)).float()
            weight = both.float() + (JUMP_WEIGHT - 1) * jump
            errors = errors + (weight * (ours - true).abs()).sum()
            weights = weights + weight.sum()
            order = nn.functional.softplus(-true.sign() * ours / MARGIN)
            orders, jumps = orders + (jump * order).sum(), jumps + jump.sum()
    return errors / weights.clamp(min=1), orders / jumps.clamp(min=1)


def mark_loss(logit: Tensor, truth: Tensor) -> Tensor:
    """Binary cross-entropy over the cells with ink, (B, h, w): 1 is a mark, 0 a line, -1 no ink."""
    inked = (truth >= 0).float()
    each = nn.functional.binary_cross_entropy_with_logits(
        logit, truth.clamp(min=0), reduction="none", pos_weight=logit.new_tensor(MARK_SEEN)
    )
    return (each * inked).sum() / inked.sum().clamp(min=1)


def bend_loss(found: Tensor, truth: Tensor, mask: Tensor) -> Tensor:
    """How surely the surface is round where it is round, and hollow where it is hollow: the mean
    of ``softplus(-sign x bend)`` over bent cells.

    Args:
        found, truth: (B, 3, H, W) unit normals. mask: (B, H, W) float32.
    """
    side = float(mask.shape[1] * mask.shape[2]) ** 0.5
    inside = nn.functional.avg_pool2d(mask[:, None], COARSE)[:, 0]
    ours, true = (bends(normals * mask[:, None], side) for normals in (found, truth))
    # A cell beside the outline has no neighbour to compare with.
    inner = -nn.functional.max_pool2d(-(inside > 0.99).float()[:, None], 3, 1, 1)[:, 0]
    weight = inner * (true.abs() > CURVED) * (1 + (HOLLOW_WEIGHT - 1) * (true < 0))
    each = nn.functional.softplus(-true.sign() * ours)
    return (weight * each).sum() / weight.sum().clamp(min=1)


def bends(normals: Tensor, side: float) -> Tensor:
    """(B, 3, H, W) -> (B, h, w) divergence of the normals' means over cells, per ``side`` pixels:
    above 0 where the surface is round, below where it is hollow."""
    cells = nn.functional.avg_pool2d(normals, COARSE)
    padded = nn.functional.pad(cells, (1, 1, 1, 1), mode="replicate")
    across = padded[:, 0, 1:-1, 2:] - padded[:, 0, 1:-1, :-2]
    up = padded[:, 1, :-2, 1:-1] - padded[:, 1, 2:, 1:-1]
    return (across + up) * (side / (2 * COARSE))


def angles(a: Tensor, b: Tensor) -> Tensor:
    """Angle in radians between two (B, 3, H, W) maps of unit vectors: (B, H, W).

    Computed from the chord, because the derivative of the arc cosine is infinite at 0.
    """
    half = (a - b).square().sum(dim=1).add(1e-6).sqrt() / 2
    return 2 * torch.asin(half.clamp(max=0.9999))
