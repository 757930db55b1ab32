"""Muon: momentum whose every singular value counts the same (Jordan 2024).

A step of Adam's on a layer's weights is led by few directions in which all examples agree. Muon
brings the momentum's singular values near 1, so that the rare directions are learnt as well: on
drawings it learns more in the same time although its steps cost more.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

import torch
from torch import Tensor

_LINEAR, _CUBIC, _QUINTIC = 3.4445, -4.7750, 2.0315
_ROUNDS = 5
_ADAM_RMS = 0.2


class Muon(torch.optim.Optimizer):
    """For weights of two and more dimensions, each taken as a matrix of its outputs.

    At one learning rate its steps are as large as Adam's typically are (Liu 2025).
    """

    def __init__(
        self, weights: Iterable[Tensor], lr: float, weight_decay: float, momentum: float = 0.95
    ) -> None:
        super().__init__(weights, {"lr": lr, "decay": weight_decay, "momentum": momentum})

    @torch.no_grad()
    def step(self) -> None:  # type: ignore[override]
        """Move every weight; all must have a gradient."""
        for group in self.param_groups:
            alike: dict[tuple[int, int], list[tuple[Tensor, Tensor]]] = defaultdict(list)
            for weight in group["params"]:
                mean = self.state[weight].setdefault("mean", torch.zeros_like(weight))
                mean.lerp_(weight.grad, 1 - group["momentum"])
                ahead = weight.grad.lerp(mean, group["momentum"]).flatten(1)
                wide = ahead if len(ahead) <= ahead.shape[1] else ahead.mT
                alike[wide.shape[0], wide.shape[1]].append((weight, wide))
            for (_, longest), pairs in alike.items():
                steps = orthogonal(torch.stack([wide for _, wide in pairs]))
                for (weight, _), step in zip(pairs, steps, strict=True):
                    outputs = step if len(step) == len(weight) else step.mT
                    weight.mul_(1 - group["lr"] * group["decay"])
                    size = group["lr"] * _ADAM_RMS * longest**0.5
                    weight.sub_(outputs.reshape(weight.shape), alpha=size)


def orthogonal(matrices: Tensor) -> Tensor:
    """(K, m, n) float32, m at most n -> the nearest of orthonormal rows, roughly: singular values
    above a hundredth of the norm come out between 0.6 and 1.3.

    Newton-Schulz iteration by a quintic (Jordan 2024) whose every round is a polynomial of
    ``x @ x.mT``. So it is carried out on that m x m product, and ``x``, nine times as wide where
    it comes of a 3 x 3 convolution, is multiplied once at the end.
    """
    x = matrices / matrices.flatten(1).norm(dim=1).clamp(min=1e-7)[:, None, None]
    gram = x @ x.mT
    through = torch.eye(gram.shape[1]).expand_as(gram)
    for left in reversed(range(_ROUNDS)):
        factor = torch.baddbmm(gram, gram, gram, beta=_CUBIC, alpha=_QUINTIC)
        factor.diagonal(dim1=1, dim2=2).add_(_LINEAR)
        through = factor @ through
        if left:
            gram = gram @ (factor @ factor)
    found: Tensor = through @ x
    return found
