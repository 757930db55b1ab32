"""The commands that research adds to ``lampblack``."""

from .dataset import build
from .evaluate import evaluate
from .flicker import flicker
from .train import train

__all__ = ["build", "evaluate", "flicker", "train"]
