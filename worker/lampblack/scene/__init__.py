"""The scene: everything that says how drawings are lit, as one frozen tree.

Canvas frame, in the drawing's own pixels: x right, y down, origin at the drawing's top left
corner, z towards the viewer, the paper at z = 0. Colours are ``#rrggbb`` in sRGB. The tree
goes to JSON and back; fields this version does not know are kept and written out again.
"""

from .depth import (
    MAX_HINT_POINTS,
    MAX_HINTS,
    Depth,
    DepthColour,
    DepthHint,
    DepthPoint,
    DepthStroke,
    Drawn,
    Hint,
    LayerBody,
)
from .document import (
    MAX_JSON_BYTES,
    decode_depth,
    decode_rig,
    decode_scene,
    decode_style,
    encode_rig,
    encode_scene,
    encode_style,
    normalize_schema,
    scene_schema,
)
from .floor import Floor, FloorKey
from .lights import Ambient, AreaLight, LightKey, PaintedLight, Pin, shining
from .look import MAX_TONES, Look, Rim
from .materials import Material
from .rig import Rig
from .scene import MAX_LIGHTS, VERSION, Canvas, Scene, default_light, default_scene
from .style import Style
from .values import MAX_KEYS, Colour

__all__ = [
    "MAX_HINTS",
    "MAX_HINT_POINTS",
    "MAX_JSON_BYTES",
    "MAX_KEYS",
    "MAX_LIGHTS",
    "MAX_TONES",
    "VERSION",
    "Ambient",
    "AreaLight",
    "Canvas",
    "Colour",
    "Depth",
    "DepthColour",
    "DepthHint",
    "DepthPoint",
    "DepthStroke",
    "Drawn",
    "Floor",
    "FloorKey",
    "Hint",
    "LayerBody",
    "LightKey",
    "Look",
    "Material",
    "PaintedLight",
    "Pin",
    "Rig",
    "Rim",
    "Scene",
    "Style",
    "decode_depth",
    "decode_rig",
    "decode_scene",
    "decode_style",
    "default_light",
    "default_scene",
    "encode_rig",
    "encode_scene",
    "encode_style",
    "normalize_schema",
    "scene_schema",
    "shining",
]
