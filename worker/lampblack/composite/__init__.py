"""Compositing: the light, the drawing's own colours, and its own ink."""

from .composite import composite

__all__ = ["composite"]
