"""Rendering: Cycles in a child process traces the light passes of a relief."""

from .client import RenderChild
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
    "LightPasses",
    "Passes",
    "Quality",
    "RenderChild",
    "RenderRequest",
    "Sampling",
    "Surface",
    "assign_materials",
    "frame_request",
    "vertex_pixels",
]
