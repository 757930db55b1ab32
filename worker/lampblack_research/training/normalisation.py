"""Statistics of normalisations, taken for the weights that will be used."""

from __future__ import annotations

from collections.abc import Callable

import torch
from torch import nn


def retake_statistics(network: nn.Module, show: Callable[[], object], rounds: int) -> None:
    """Take the means and variances of all batch normalisations anew.

    Averaged weights answer with other statistics than any of the weights they are the average
    of, so an average of statistics does not fit them.

    Args:
        network: in evaluation mode, and so on return.
        show: lets ``network`` see one batch.
        rounds: batches; all count the same.
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
            show()
    network.eval()
