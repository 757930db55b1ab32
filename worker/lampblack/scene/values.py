"""Kinds of values in the scene, with their ranges."""

from __future__ import annotations

from typing import Annotated, Any

from msgspec import Meta

from ..affects import Affects

MAX_KEYS = 128
"""Of a light or a floor: so many of each fit into one message."""

Colour = Annotated[
    str,
    # Python's $ also matches before a final newline: the length shuts that door.
    Meta(pattern="^#[0-9a-f]{6}$", max_length=7, description="sRGB, lower case #rrggbb"),
]
Pixels = Annotated[float, Meta(ge=-1e5, le=1e5, description="canvas pixels")]
Unit = Annotated[float, Meta(ge=0, le=1)]
Strength = Annotated[float, Meta(ge=0, le=100)]
Power = Annotated[Strength, Meta(description="strength: 1 shows white as it is drawn, see above")]
Diameter = Annotated[float, Meta(ge=1, le=1e5, description="diameter, canvas pixels")]
Pitch = Annotated[float, Meta(ge=5, le=85, description="degrees")]
LayerTitle = Annotated[
    str, Meta(pattern=r"^[^\x00-\x1f\x7f]*$", max_length=200, description="name of a layer")
]
Title = Annotated[str, Meta(max_length=80, description="for people")]
KeyFrame = Annotated[int, Meta(ge=0, le=999_999, description="frame of the animation")]
Extra = Annotated[dict[str, Any], Affects.NOTHING]
