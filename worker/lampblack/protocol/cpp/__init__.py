"""Generates the plugin's C++ for the scene and the messages."""

from __future__ import annotations

from pathlib import Path

from . import messages, scene
from .text import formatted

FOLDER = Path("pencil2d_plugin")


def sources(root: Path) -> dict[Path, str]:
    """The content of every generated C++ file of the checkout at ``root``."""
    written = {**scene.files(), **messages.files()}
    return {
        path: formatted(text, path)
        for path, text in ((root / FOLDER / name, text) for name, text in written.items())
    }
