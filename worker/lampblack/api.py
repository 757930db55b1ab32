"""The entry from Python: ``lampblack.light``."""

from __future__ import annotations

import atexit
import functools
import threading
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .cache import surface_cache
from .drawing import decompose_drawing, load_picture
from .finals.scene_overrides import read_scene
from .pipeline import Pipeline
from .scene import Canvas, Scene, default_scene
from .timeline import scene_at

Picture = NDArray[np.uint8] | str | Path

_ONE_AT_A_TIME = threading.Lock()


def light(
    picture: Picture,
    scene: Scene | str | Path | None = None,
    *,
    mask: Picture | None = None,
    ink: Picture | None = None,
) -> NDArray[np.uint8]:
    """Light one drawing, as ``lampblack render`` does.

    The first call starts the renderer, which takes seconds; later calls share it. It ends with
    this process.

    Args:
        picture: (H, W, 4) uint8, sRGB, straight alpha; or a PNG file.
        scene: what lights it, in the drawing's pixels; or a scene file; None is one white light.
            Lights with keys shine as in frame 1, whose hints of depth count.
        mask, ink: pictures of the same size, in the same form, whose white or opaque part is the
            character mask, and whose dark or opaque part is the ink line; None finds them.

    Returns:
        (H, W, 4) uint8, sRGB, straight alpha: the drawing, lit.

    Raises:
        DrawingError: a picture cannot be read, or nothing is drawn on it.
        SceneError: the scene file cannot be read.
        RenderError: the renderer failed.
    """
    drawing = decompose_drawing(
        _pixels(picture),
        mask=None if mask is None else _pixels(mask),
        ink=None if ink is None else _pixels(ink),
    )
    canvas = Canvas(*drawing.size)
    if scene is None:
        scene = default_scene(canvas.width, canvas.height)
    elif not isinstance(scene, Scene):
        scene = read_scene(Path(scene))
    depth = replace(
        scene.depth,
        hints=tuple(hint for hint in scene.depth.hints if hint.frame == 1),
        strokes=tuple(stroke for stroke in scene.depth.strokes if stroke.frame == 1),
    )
    scene = replace(scene_at(scene, 1), canvas=canvas, depth=depth)
    with _ONE_AT_A_TIME:
        return _pipeline().render(drawing, scene)


@functools.cache
def _pipeline() -> Pipeline:
    pipeline = Pipeline(surface_cache())
    atexit.register(pipeline.close)
    return pipeline


def _pixels(picture: Picture) -> NDArray[np.uint8]:
    return load_picture(picture) if isinstance(picture, str | Path) else picture
