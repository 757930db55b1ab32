"""Compositing: the passes of light laid over the drawing."""

from .composite import composite

__all__ = ["composite"]
