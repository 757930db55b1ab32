"""The command line: the same pipeline without Pencil2D."""

from .app import main

__all__ = ["main"]
