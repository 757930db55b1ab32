"""The composite of the light, the drawing's own colours, and its own ink."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..drawing import Drawing
from ..render.passes import Passes
from ..scene import Scene
from .byte_composite import composite_bytes
from .byte_layers import ByteLayers
from .float_kernel import composite_float
from .form import Form
from .illumination import Illumination
from .resample import Box


def composite(
    layers: Drawing | ByteLayers,
    light: Passes | Illumination,
    scene: Scene,
    crop: Box | None = None,
    edges: NDArray[np.uint8] | None = None,
    form: Form | None = None,
) -> NDArray[np.uint8]:
    """The lit drawing, (H, W, 4) uint8 sRGB, for finals and for previews.

    The character's fill is lit in scene-linear light. Then its ink is composited over the fill,
    and the character over the background, both in sRGB as in the drawing program. Light of unit
    irradiance gives the drawing back to within 1/255. Highlights brighter than white are
    compressed below white; their hue is kept.

    Args:
        layers: a ``Drawing`` is composited in floating point, and the result has straight alpha.
            ``ByteLayers`` are composited in one fast loop, and the result is premultiplied, for
            screens. The two agree to 4 levels.
        light: may have another size than the layers. The weights of passes come from ``scene``.
        scene: provides materials, and colours and powers of lights.
        crop: the part of the drawing in the byte layers, in the drawing's pixels; None is all.
        edges: what the rim of the scene follows in a ``Drawing``, see ``edge_distance``; None is
            its silhouette. Byte layers have their own.
        form: the surface that ``light`` falls on, where it is passes; see ``Illumination``.
    """
    illumination = light if isinstance(light, Illumination) else Illumination.of(light, scene, form)
    if isinstance(layers, ByteLayers):
        whole = (0.0, 0.0, float(layers.size[0]), float(layers.size[1]))
        return composite_bytes(layers, illumination, scene, crop or whole)
    return composite_float(layers, illumination, scene, edges)
