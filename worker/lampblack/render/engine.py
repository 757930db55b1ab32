"""Cycles' passes, read from memory.

Headless Blender keeps no pixels: 'Render Result' is empty, the Viewer node does nothing, and
files are slow. So the engine's ``render`` is wrapped, to read its passes before they are freed.
"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .spent import spent_on


def render_passes(scene: Any) -> dict[str, NDArray[np.float32]]:
    """Render ``scene`` with Cycles. Returns its passes by Blender's names, (h, w, channels)
    float32, row 0 at the top.

    Raises:
        RuntimeError: Blender has no Cycles, or Cycles gave no picture.
    """
    cycles = next(
        (e for e in bpy.types.RenderEngine.__subclasses__() if e.__name__ == "CyclesRender"), None
    )
    if cycles is None:
        raise RuntimeError("this Blender has no Cycles")
    passes: dict[str, NDArray[np.float32]] = {}
    plain_render = cycles.render

    def render_and_read(engine: Any, depsgraph: Any) -> None:
        with spent_on("cycles"):
            plain_render(engine, depsgraph)
        for layer_pass in engine.get_result().layers[0].passes:
            pixels = np.zeros(width * height * layer_pass.channels, np.float32)
            layer_pass.rect.foreach_get(pixels)
            passes[layer_pass.name] = pixels.reshape(height, width, -1)[::-1]

    width, height = scene.render.resolution_x, scene.render.resolution_y
    cycles.render = render_and_read
    try:
        bpy.ops.render.render(scene=scene.name)
    finally:
        cycles.render = plain_render
    if not passes:
        raise RuntimeError("Cycles gave no picture")
    return passes
