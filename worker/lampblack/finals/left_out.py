"""What a picture or a file leaves out of a scene is said."""

from __future__ import annotations

import warnings

from ..choices import GlowName
from ..errors import LampblackWarning
from ..prepared import PreparedDrawing
from ..scene import Scene

_GLOWS: dict[GlowName, str] = {
    "emission": "the light that emissive colours throw",
    "painted": "painted light",
}


def warn_without_glows(prepared: PreparedDrawing, scene: Scene, made: str) -> None:
    """Warn of light that comes from surfaces, if there is any.

    Args:
        made: what leaves it out, such as "The turntable".
    """
    missing = [_GLOWS[name] for name in prepared.glows(scene)]
    if missing:
        words = f"{made} leaves out {' and '.join(missing)}."
        warnings.warn(words, LampblackWarning, stacklevel=2)
