"""Small pictures of a drawing under several rigs, made in a moment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..camera import Affine, box_on_canvas, scene_in_view
from ..composite import composite
from ..composite.byte_layers import ByteLayers
from ..composite.edges import reach_of
from ..composite.resample import Box
from ..prepared import PreparedDrawing
from ..rigs import PRESETS, preset, rig_of, with_rig
from ..scene import Rig, Scene
from ..timeline import scene_at
from .sketch import SketchedSurface

MARGIN = 0.06
"""Of the figure's longer side, around it in a picture."""


def placed_presets(drawing: PreparedDrawing, scene: Scene, camera: Affine) -> list[Rig]:
    """The rigs that come with Lampblack, placed on the figure, in pixels of the scene's canvas."""
    box = box_on_canvas(drawing.box, camera)
    found = []
    for rig in map(preset, PRESETS):
        lit = with_rig(scene, rig, box)
        rim = None if rig.rim is None else lit.rim
        found.append(replace(rig_of(lit, rig.name), look=rig.look, rim=rim))
    return found


def placed(rig: Rig, scene: Scene) -> Rig:
    """``rig`` on the whole canvas of ``scene``."""
    lit = with_rig(scene, rig)
    rim = None if rig.rim is None else lit.rim
    return replace(rig_of(lit, rig.name), look=rig.look, rim=rim, extra=rig.extra)


def rig_pictures(
    drawing: PreparedDrawing,
    scene: Scene,
    camera: Affine,
    rigs: Sequence[Rig],
    side: int,
    frame: int = 1,
) -> NDArray[np.uint8]:
    """A square picture for each rig, one below the other: (N * side, side, 4) uint8 sRGB,
    premultiplied. The figure fills them.

    Args:
        drawing: with normals.
        scene: on the canvas, with the materials.
        camera: from the canvas to the drawing.
        rigs: in pixels of the canvas.
        frame: at which keyed lights are shown.
    """
    crop = _around(drawing.box)
    step = drawing.step
    whole = drawing.compact().layers
    assert isinstance(whole, ByteLayers)
    if scene.rim is not None or any(rig.rim is not None for rig in rigs):
        unit = reach_of(drawing.edges.shape) * step / 255
        whole = replace(whole, edges=drawing.edges, edge_unit=unit)
    x, y, width, height = (value / step for value in crop)
    layers = whole.cut((x, y, width, height), (side, side))
    surface = SketchedSurface.of(drawing, crop, (side, side))
    pictures = [np.zeros((0, side, 4), np.uint8)]
    for rig in rigs:
        lit = scene_at(replace(with_rig(scene, rig), floor=None), frame)
        seen = scene_in_view(lit, camera, drawing.size)
        within = (0.0, 0.0, float(side), float(side))
        pictures.append(composite(layers, surface.passes(seen), seen, within))
    return np.concatenate(pictures)


def _around(box: Box) -> Box:
    """A square around ``box``."""
    x, y, width, height = box
    side = max(width, height) * (1 + 2 * MARGIN)
    return x + (width - side) / 2, y + (height - side) / 2, side, side
