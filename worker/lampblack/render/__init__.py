"""Rendering: Cycles in a child process turns a relief and lights into passes of light."""

from .client import RenderChild
from .passes import LightPasses, Passes
from .quality import QUALITIES, Quality, Sampling
from .request import RenderRequest, Surface, frame_request

__all__ = [
    "QUALITIES",
    "LightPasses",
    "Passes",
    "Quality",
    "RenderChild",
    "RenderRequest",
    "Sampling",
    "Surface",
    "frame_request",
]
