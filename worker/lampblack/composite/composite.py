"""The composite: light over the drawing's own colours, under its own ink."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..drawing import Drawing
from ..render.passes import Passes
from ..scene import Scene
from .byte_kernel import composite_bytes
from .byte_layers import ByteLayers
from .float_kernel import composite_float
from .illumination import Illumination
from .resample import Box


def composite(
    layers: Drawing | ByteLayers,
    light: Passes | Illumination,
    scene: Scene,
    crop: Box | None = None,
) -> NDArray[np.uint8]:
    """The drawing, lit, (H, W, 4) uint8 sRGB, for finals and for previews.

    The character's fill is lit in scene-linear light, its ink laid over that, and the character
    over the background, both in sRGB as the drawing program does it. Light of unit irradiance
    gives the drawing back to within 1/255. What is brighter than white is bent below white, its
    hue kept.

    Args:
        layers: a drawing, composited in floating point, with straight alpha in the result; or
            byte layers, composited in one fast loop, premultiplied as screens take it. The two
            agree to 4 levels.
        light: may be of another size than the layers. Of passes, the weights come from ``scene``.
        scene: its materials, and its lights' colours and powers.
        crop: what of the drawing byte layers show, the drawing's pixels; None is all of it.
    """
    illumination = light if isinstance(light, Illumination) else Illumination.of(light, scene)
    if isinstance(layers, ByteLayers):
        whole = (0.0, 0.0, float(layers.size[0]), float(layers.size[1]))
        return composite_bytes(layers, illumination, scene, crop or whole)
    return composite_float(layers, illumination, scene)
