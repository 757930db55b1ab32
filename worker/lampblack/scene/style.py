"""A style: a look and a rim to use again."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from msgspec import Meta

from .look import Look, Rim
from .scene import VERSION, Canvas
from .values import Extra, Title


@dataclass(frozen=True)
class Style:
    """How the light of a scene is shown, to be used again in other shots.

    The width of the rim is in pixels of the style's own ``canvas``. On another canvas, the longer
    side is as long as the longer side. See ``looks/``.
    """

    canvas: Canvas
    name: Title = ""
    look: Look = field(default_factory=Look)
    rim: Rim | None = None
    version: Annotated[int, Meta(ge=VERSION, le=VERSION)] = VERSION
    extra: Extra = field(default_factory=dict)
