"""The live preview: threads prepare drawings, trace light and paint pictures."""

from .contribution import LightContribution
from .live import LivePreview
from .painter import PreviewImage
from .request import Viewport, ViewRequest
from .state import PreviewState, RendererState
from .tracer import PreviewRenderer

__all__ = [
    "LightContribution",
    "LivePreview",
    "PreviewImage",
    "PreviewRenderer",
    "PreviewState",
    "RendererState",
    "ViewRequest",
    "Viewport",
]
