"""Compositing: light over the drawing's own colours, under its own ink."""

from .composite import composite

__all__ = ["composite"]
