"""Compositing: the passes of light laid over the drawing."""

from .composite import composite, composite_unrounded

__all__ = ["composite", "composite_unrounded"]
