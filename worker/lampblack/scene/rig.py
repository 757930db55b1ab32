"""A rig: lights to use again, on a canvas of their own."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from msgspec import Meta

from .lights import Ambient, AreaLight
from .look import Look, Rim
from .scene import MAX_LIGHTS, VERSION, Canvas
from .values import Extra, Title


@dataclass(frozen=True)
class Rig:
    """The light of a scene without what it falls on, to be used again in other shots.

    Places are in pixels of the rig's own ``canvas``. They are moved to another canvas, or to the
    box around a figure, with the middle on the middle and the longer side as long as the longer
    side. See ``rigs/``. A ``look`` replaces that of the scene too, and so does a
    ``rim``; a look without a rim removes the scene's.
    """

    canvas: Canvas
    name: Title = ""
    lights: Annotated[tuple[AreaLight, ...], Meta(max_length=MAX_LIGHTS)] = ()
    ambient: Ambient = field(default_factory=Ambient)
    look: Look | None = None
    rim: Rim | None = None
    version: Annotated[int, Meta(ge=VERSION, le=VERSION)] = VERSION
    extra: Extra = field(default_factory=dict)
