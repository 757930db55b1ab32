"""Rendering: Cycles in a child process turns a relief and lights into passes of light."""

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
from .wire import Expose

__all__ = [
    "QUALITIES",
    "Expose",
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
