"""Muon: momentum with all singular values brought near 1 (Jordan 2024).

In a step of Adam a few directions, in which all examples agree, are the largest. Muon gives rare
directions the same weight. On drawings it learns more in the same time, although a step takes
longer.
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
    """For weights of two and more dimensions; each is a matrix with one row for each output.

    At the same learning rate its steps are about as large as Adam's (Liu 2025).
    """

    def __init__(
        self, weights: Iterable[Tensor], lr: float, weight_decay: float, momentum: float = 0.95
    ) -> None:
        super().__init__(weights, {"lr": lr, "decay": weight_decay, "momentum": momentum})

    @torch.no_grad()
    def step(self) -> None:  # type: ignore[override]
        """Update every weight; all must have a gradient."""
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

    Newton-Schulz iteration with a quintic (Jordan 2024). Every round is a polynomial of
    ``x @ x.mT``, so the rounds run on that m x m product, and ``x`` is multiplied once at the end.
    ``x`` is nine times as wide for a 3 x 3 convolution.
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
