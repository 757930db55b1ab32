"""Styles in scenes."""

from __future__ import annotations

from dataclasses import replace

from ..scene import Rim, Scene, Style

_NARROWEST, _WIDEST = 0.25, 1000.0


def with_style(scene: Scene, style: Style) -> Scene:
    """``scene`` with the look and the rim of ``style``, which replace its own."""
    scale = scene.canvas.default_height / style.canvas.default_height
    return replace(scene, look=style.look, rim=scaled_rim(style.rim, scale))


def scaled_rim(rim: Rim | None, scale: float) -> Rim | None:
    """The rim on a canvas that is ``scale`` times as large."""
    if rim is None:
        return None
    return replace(rim, width=min(_WIDEST, max(_NARROWEST, rim.width * scale)))
