"""Batch normalisation statistics of averaged weights."""

from __future__ import annotations

from collections.abc import Callable

import torch
from torch import nn


def recompute_statistics(network: nn.Module, forward: Callable[[], object], rounds: int) -> None:
    """Recompute the means and variances of all batch normalisations.

    The average of several weights has other statistics than each of them, and also other
    statistics than their average.

    Args:
        network: in evaluation mode, and so on return.
        forward: runs ``network`` on one batch.
        rounds: number of batches; all have the same weight.
    """
    layers = [layer for layer in network.modules() if isinstance(layer, nn.BatchNorm2d)]
    if not layers:
        return
    for layer in layers:
        layer.reset_running_stats()
        layer.momentum = None  # the plain mean over all batches
    network.train()
    with torch.no_grad():
        for _ in range(rounds):
            forward()
    network.eval()
