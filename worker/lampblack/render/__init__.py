"""Rendering: Cycles in a child process traces the light passes of a relief."""

from .client import RenderChild
from .emitters import Emitter, glowing_parts, painted_plane
from .passes import LightPasses, Passes
from .quality import QUALITIES, Quality, Sampling
from .request import (
    RenderRequest,
    Surface,
    assign_materials,
    frame_request,
    vertex_pixels,
)
from .wire import Accumulate

__all__ = [
    "QUALITIES",
    "Accumulate",
    "Emitter",
    "LightPasses",
    "Passes",
    "Quality",
    "RenderChild",
    "RenderRequest",
    "Sampling",
    "Surface",
    "assign_materials",
    "frame_request",
    "glowing_parts",
    "painted_plane",
    "vertex_pixels",
]
